#include "arm/compiled_formula.hpp"

#include "arm/ascii.hpp"
#include "arm/decimal_comma.hpp"
#include "arm/formula_syntax.hpp"
#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <muParser.h>
#include <numbers>
#include <string_view>
#include <tbb/enumerable_thread_specific.h>
#include <utility>

namespace flexarm::arm {

namespace {

/// As a variable of the parser; no name of a user begins with an underscore.
constexpr std::string_view kDirection = "_direction";
constexpr std::string_view kPi = "pi";
/// Numbers of a formula's own, each of which is compared with all.
constexpr std::size_t kMostNumbers = 100;

mu::Parser plain_parser() {
  mu::Parser parser;
  parser.ClearConst();
  parser.DefineConst(std::string(kPi), std::numbers::pi);
  return parser;
}

/// What is no ASCII, such as Greek, is taken for a letter, so that it is refused as a whole word.
bool is_of_word(char c) {
  return is_letter(c) || is_digit(c) || c == '_' || is_beyond_ascii(c);
}

std::vector<std::string> names_of_functions(const mu::Parser& parser) {
  std::vector<std::string> names;
  for (const auto& entry : parser.GetFunDef()) names.push_back(entry.first);
  return names;
}

/// Reads a formula word by word, so that every fault is named in the user's own terms.
class FormulaReader {
 public:
  FormulaReader(const std::string& text, const std::vector<std::string>& numbers)
      : text_(text), parser_(plain_parser()), functions_(names_of_functions(parser_)) {
    names_ = formula_variables();
    names_.emplace_back(kPi);
    for (const std::string& number : numbers) add_number(number);
  }

  /// The text with sign(omega) replaced by a variable and blanks, so that places stay.
  std::string read() {
    while (at_ < text_.size()) {
      if (begins_number(text_, at_)) {
        at_ = number_end(text_, at_);
      } else if (is_of_word(text_[at_])) {
        read_word();
      } else {
        read_sign();
      }
    }
    return std::move(text_);
  }

  const std::set<std::string>& used() const { return used_; }
  bool is_algebraic() const { return is_algebraic_; }

 private:
  void add_number(const std::string& name) {
    if (name.empty() || !is_letter(name.front()) || !std::ranges::all_of(name, [](char c) {
          return is_letter(c) || is_digit(c) || c == '_';
        })) {
      throw InputError("no name of a number; must be letters, digits and _, a letter first", name);
    }
    if (std::ranges::count(names_, name) + std::ranges::count(functions_, name) > 0) {
      throw InputError(
          "a variable, constant or function of formulas has this name; a number needs another",
          name);
    }
    names_.push_back(name);
  }

  std::size_t behind_blanks(std::size_t at) const {
    while (at < text_.size() && (text_[at] == ' ' || text_[at] == '\t')) ++at;
    return at;
  }

  std::string word_at(std::size_t at) const {
    std::size_t end = at;
    while (end < text_.size() && is_of_word(text_[end])) ++end;
    return text_.substr(at, end - at);
  }

  void read_word() {
    const std::string word = word_at(at_);
    const std::size_t end = at_ + word.size();
    const std::size_t next = behind_blanks(end);
    if (next < text_.size() && text_[next] == '(') {
      read_call(word, next + 1);
      return;
    }
    if (std::ranges::count(names_, word) == 0) {
      throw InputError(fmt::format(
          "{}: unknown variable{}; allowed: {}; a number of the law needs a key beside hub_torque",
          shown(word), did_you_mean(word, names_), fmt::join(names_, ", ")));
    }
    used_.insert(word);
    at_ = end;
  }

  /// `inside` is behind the opening parenthesis.
  void read_call(const std::string& function, std::size_t inside) {
    if (std::ranges::count(functions_, function) == 0) {
      throw InputError(fmt::format("{}: unknown function{}; allowed: {}", shown(function),
                                   did_you_mean(function, functions_),
                                   fmt::join(functions_, ", ")));
    }
    const std::size_t argument = behind_blanks(inside);
    const std::size_t close = behind_blanks(argument + word_at(argument).size());
    if (function == "sign" && word_at(argument) == "omega" && close < text_.size() &&
        text_[close] == ')') {
      std::string direction(kDirection);
      direction.resize(close + 1 - at_, ' ');
      text_.replace(at_, direction.size(), direction);
      used_.insert(std::string(kDirection));
      at_ = close + 1;
      return;
    }
    is_algebraic_ = false;
    at_ = inside;
  }

  void read_sign() {
    const char c = text_[at_];
    const bool is_pair = at_ + 1 < text_.size() && text_[at_ + 1] == '=';
    if (c == '=' && !is_pair) {
      throw InputError(
          fmt::format("= at character {}: a formula assigns nothing; equality is ==", at_ + 1));
    }
    constexpr std::string_view kOfSums = "+-*/^(). \t";
    constexpr std::string_view kOthers = "=<>!&|?:,";
    if (kOfSums.find(c) == std::string_view::npos) {
      is_algebraic_ = false;
      if (kOthers.find(c) == std::string_view::npos) {
        throw InputError(fmt::format("character {}, {}: not allowed in a formula", at_ + 1,
                                     shown(std::string_view(text_).substr(at_, 1))));
      }
    }
    at_ += is_pair && kOthers.find(c) != std::string_view::npos ? 2U : 1U;
  }

  std::string text_;
  mu::Parser parser_;
  std::vector<std::string> functions_;
  std::vector<std::string> names_;
  std::set<std::string> used_;
  bool is_algebraic_ = true;
  std::size_t at_ = 0;
};

}  // namespace

/// A parser with the variables that it reads.
class CompiledFormula::Parser {
 public:
  /// Throws mu::ParserError.
  Parser(const std::string& text, const std::vector<std::string>& numbers)
      : cells_(formula_variables().size() + 1 + numbers.size(), 1.0), parser_(plain_parser()) {
    std::size_t cell = 0;
    for (const std::string& name : formula_variables()) parser_.DefineVar(name, &cells_[cell++]);
    parser_.DefineVar(std::string(kDirection), &cells_[cell++]);
    for (const std::string& name : numbers) parser_.DefineVar(name, &cells_[cell++]);
    parser_.SetExpr(text);
    parser_.Eval(results_);
  }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  int results() const { return results_; }

  double operator()(const HubState& hub, double direction, std::span<const double> numbers) {
    cells_[0] = hub.angle_rad;
    cells_[1] = hub.velocity_rad_per_s;
    cells_[2] = hub.torque_N_m;
    cells_[3] = hub.time_s;
    cells_[4] = direction;
    std::ranges::copy(numbers, cells_.begin() + 5);
    return parser_.Eval();
  }

 private:
  std::vector<double> cells_;
  mu::Parser parser_;
  int results_ = 0;
};

struct CompiledFormula::Parsers {
  std::string text;  ///< as the parser takes it
  std::vector<std::string> numbers;
  tbb::enumerable_thread_specific<std::unique_ptr<Parser>> of_thread = {};

  Parser& mine() {
    auto& parser = of_thread.local();
    if (parser == nullptr) parser = std::make_unique<Parser>(text, numbers);
    return *parser;
  }
};

CompiledFormula::CompiledFormula(const std::string& text, const std::vector<std::string>& numbers) {
  if (numbers.size() > kMostNumbers) {
    throw InputError(fmt::format("has {} numbers of its own; must be {} or fewer", numbers.size(),
                                 kMostNumbers));
  }
  FormulaReader reader(text, numbers);
  parsers_ = std::make_unique<Parsers>(Parsers{reader.read(), numbers});
  try {
    if (parsers_->mine().results() != 1) {
      throw InputError("has several values between commas; must have one" +
                       decimal_comma_hint(text));
    }
  } catch (const mu::ParserError& error) {
    // Errors of a token come with the place behind it or in front of it.
    const auto place = static_cast<std::size_t>(std::max(0, error.GetPos()));
    throw InputError(syntax_fault(error, "a variable", text, place));
  }
  variables_ = reader.used();
  is_algebraic_ = reader.is_algebraic();
  has_direction_ = variables_.contains(std::string(kDirection));
  for (const std::string& number : numbers) {
    if (!variables_.contains(number)) {
      throw InputError("does not stand in the formula", number);
    }
  }
}

CompiledFormula::~CompiledFormula() = default;

double CompiledFormula::operator()(const HubState& hub, double direction,
                                   std::span<const double> numbers) const {
  return parsers_->mine()(hub, direction, numbers);
}

const std::vector<std::string>& formula_variables() {
  static const std::vector<std::string> names = {"theta", "omega", "tau", "t"};
  return names;
}

}  // namespace flexarm::arm
