#pragma once

#include <string>
#include <vector>

namespace flexarm::texts {

/// A text that a user reads, and where it stands.
struct Text {
  std::string where;  ///< file and line
  std::string text;   ///< one line, words separated by single blanks
};

/// String literals of C++ source, adjacent ones joined; no comments and no preprocessor lines.
std::vector<Text> literals(const std::string& source, const std::string& file);

/// Paragraphs and list items of Markdown, and its table rows if `with_tables`; no code blocks.
std::vector<Text> paragraphs(const std::string& markdown, const std::string& file,
                             bool with_tables);

/// Sentences of a paragraph. Code and formulas in it count as one word each.
std::vector<std::string> sentences(const std::string& paragraph);

/// Words of a sentence: what has a letter or a digit.
int words(const std::string& sentence);

/// True if `phrase` stands in `text` as whole words, in any case.
bool contains_phrase(const std::string& text, const std::string& phrase);

/// Words separated by single blanks.
std::string on_one_line(const std::string& text);

}  // namespace flexarm::texts
