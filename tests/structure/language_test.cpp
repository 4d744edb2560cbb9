#include "tests/structure/texts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::texts {
namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::IsEmpty;

const fs::path kRoot = FLEXARM_SOURCE_DIR;

/// Rooms whose string literals a user reads.
const std::vector<std::string> kRooms = {"app",      "arm",      "assumed_modes", "compare",
                                         "effects",  "diagnose", "exact_tf",      "fem",
                                         "measured", "python",   "report",        "response"};

/// Not checked. Generated documents whose commands take long are checked by their templates.
const std::set<std::string> kExempt = {"docs/glossary.md",   // lists the retired phrases
                                       "docs/case-rig.md"};  // scripts/case-rig.md.in
constexpr std::string_view kScorecards = "docs/scorecard";   // tests/trials/scorecard.cpp

std::string read(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string name_of(const fs::path& path) {
  return fs::relative(path, kRoot).generic_string();
}

bool is_exempt(const fs::path& path) {
  const std::string name = name_of(path);
  return kExempt.contains(name) || name.starts_with(kScorecards);
}

/// README and the like, docs/*.md and the templates of documents.
std::vector<fs::path> documents() {
  std::vector<fs::path> paths = {kRoot / "README.md", kRoot / "CHANGELOG.md",
                                 kRoot / "CONTRIBUTING.md"};
  for (const auto& entry : fs::directory_iterator(kRoot / "docs")) {
    if (entry.path().extension() == ".md") paths.push_back(entry.path());
  }
  for (const auto& entry : fs::directory_iterator(kRoot / "scripts")) {
    if (entry.path().extension() == ".in") paths.push_back(entry.path());
  }
  std::erase_if(paths, is_exempt);
  return paths;
}

std::vector<Text> texts_of_users() {
  std::vector<Text> all;
  const auto add = [&all](std::vector<Text> some) {
    std::ranges::move(some, std::back_inserter(all));
  };
  for (const auto& path : documents()) add(paragraphs(read(path), name_of(path), true));
  for (const auto& room : kRooms) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / room)) {
      const fs::path& path = entry.path();
      if ((path.extension() == ".cpp" || path.extension() == ".hpp") && !is_exempt(path)) {
        add(literals(read(path), name_of(path)));
      }
    }
  }
  for (const char* file : {"tests/trials/scorecard.cpp", "tests/trials/calibration.cpp"}) {
    add(literals(read(kRoot / file), file));
  }
  return all;
}

struct Retired {
  std::string phrase;
  std::string term;  ///< what to write instead
};

/// The last column of the tables of docs/glossary.md without what is in italics there: that
/// depends on its context.
std::vector<Retired> retired_phrases() {
  std::vector<Retired> all;
  bool among_terms = false;
  std::istringstream lines(read(kRoot / "docs/glossary.md"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) among_terms = line == "## Terms";
    if (!among_terms || !line.starts_with("| ")) continue;
    std::vector<std::string> cells;
    std::istringstream row(line.substr(1));
    for (std::string cell; std::getline(row, cell, '|');) cells.push_back(on_one_line(cell));
    if (cells.size() != 3 || cells[0] == "term" || cells[0] == "---") continue;
    std::istringstream phrases(cells[2]);
    for (std::string phrase; std::getline(phrases, phrase, ';');) {
      const std::string one = on_one_line(phrase);
      if (!one.empty() && !one.starts_with('*')) all.push_back({one, cells[0]});
    }
  }
  return all;
}

TEST(Language, TextsDoNotUsePhrasesThatTheGlossaryRetired) {
  const auto retired = retired_phrases();
  ASSERT_GT(retired.size(), 50U) << "the last column of docs/glossary.md was not read";
  const auto texts = texts_of_users();
  ASSERT_GT(texts.size(), 3000U);
  for (const Text& one : texts) {
    for (const auto& [phrase, term] : retired) {
      EXPECT_FALSE(contains_phrase(one.text, phrase))
          << one.where << ": \"" << phrase << "\"; the glossary has: " << term << "\n"
          << one.text;
    }
  }
}

TEST(Language, SentencesOfDocumentsAreShort) {
  constexpr int kMostWords = 40;
  for (const auto& path : documents()) {
    for (const Text& paragraph : paragraphs(read(path), name_of(path), false)) {
      for (const auto& sentence : sentences(paragraph.text)) {
        EXPECT_LE(words(sentence), kMostWords) << paragraph.where << ": " << sentence;
      }
    }
  }
}

TEST(Language, ReadmeIsOnePage) {
  constexpr int kMostLines = 100;
  EXPECT_LE(std::ranges::count(read(kRoot / "README.md"), '\n'), kMostLines);
}

TEST(Language, ReadsJoinedLiteralsAndNoComments) {
  const auto found = literals(
      "#include \"a/told from.hpp\"\n// \"told\"\nconst char q = '\"';\nf(\"one \"  // why\n  "
      "\"two\\n\", \"three\", R\"(four\nfive)\");",
      "a.cpp");
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].where, "a.cpp:4");
  EXPECT_EQ(found[0].text, "one two");
  EXPECT_EQ(found[1].text, "three");
  EXPECT_EQ(found[2].text, "four five");
}

TEST(Language, ReadsParagraphsAndItemsOfMarkdown) {
  const std::string markdown =
      "# Head\n\nOne\ntwo.\n- three\n  four\n- five\n\n```\ncode\n```\n\n    code\n\n| a | b |\n";
  std::vector<std::string> texts;
  for (const Text& one : paragraphs(markdown, "a.md", false)) texts.push_back(one.text);
  EXPECT_THAT(texts, ElementsAre("One two.", "three four", "five"));
  EXPECT_EQ(paragraphs(markdown, "a.md", true).size(), 5U);
}

TEST(Language, CountsWordsOfSentences) {
  const auto found =
      sentences("As in `a.b c`, e.g. $x = 1$ [here](there.md). Two + two (or 4.) End");
  EXPECT_THAT(found, ElementsAre("As in code, e.g. formula here.", "Two + two (or 4.)", "End"));
  EXPECT_EQ(words(found[0]), 6);
  EXPECT_EQ(words(found[1]), 4);
  EXPECT_THAT(sentences(""), IsEmpty());
}

TEST(Language, FindsPhrasesAsWholeWords) {
  EXPECT_TRUE(contains_phrase("Not told from a lag.", "told from"));
  EXPECT_TRUE(contains_phrase("it is Told From", "told from"));
  EXPECT_FALSE(contains_phrase("untold from", "told from"));
  EXPECT_FALSE(contains_phrase("told fromage", "told from"));
}

}  // namespace
}  // namespace flexarm::texts
