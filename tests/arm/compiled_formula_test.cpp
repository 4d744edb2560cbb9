#include "arm/compiled_formula.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

namespace flexarm::arm {
namespace {

constexpr HubState kHub{
    .angle_rad = 0.3, .velocity_rad_per_s = -1.2, .torque_N_m = 0.05, .time_s = 2.5};

double evaluated(const std::string& text, double direction = -1.0) {
  return CompiledFormula(text, {})(kHub, direction, {});
}

TEST(CompiledFormula, ReadsTheFourVariablesAndPi) {
  EXPECT_EQ(evaluated("theta"), 0.3);
  EXPECT_EQ(evaluated("omega"), -1.2);
  EXPECT_EQ(evaluated("tau"), 0.05);
  EXPECT_EQ(evaluated("t"), 2.5);
  EXPECT_EQ(evaluated("pi"), std::numbers::pi);
}

TEST(CompiledFormula, PowersBindBeforeSigns) {
  EXPECT_DOUBLE_EQ(evaluated("-2*theta^3"), -2.0 * 0.3 * 0.3 * 0.3);
  EXPECT_DOUBLE_EQ(evaluated("1.5e-2*omega*abs(omega) + max(tau, 0, t)"), -0.0216 + 2.5);
  EXPECT_EQ(evaluated("theta > 0.2 && t <= 2.5 ? 1 : 2"), 1.0);
}

TEST(CompiledFormula, TakesItsNumbersInTheirOrder) {
  const CompiledFormula formula("a*theta + b", {"b", "a"});
  EXPECT_DOUBLE_EQ(formula(kHub, 1.0, std::vector{10.0, 2.0}), 10.6);
  EXPECT_DOUBLE_EQ(formula(kHub, 1.0, std::vector{0.0, 4.0}), 1.2);
}

TEST(CompiledFormula, TheSignOfTheVelocityIsTheDirectionThatIsGiven) {
  EXPECT_EQ(evaluated("3*sign(omega)", 1.0), 3.0);
  EXPECT_EQ(evaluated("3*sign( omega )", -1.0), -3.0);
  EXPECT_EQ(evaluated("3*sign(-omega)", -1.0), 3.0);
  EXPECT_EQ(evaluated("sign(theta)", -1.0), 1.0);
  const CompiledFormula friction("-0.01*sign(omega)", {});
  EXPECT_TRUE(friction.has_direction());
  EXPECT_FALSE(friction.uses("omega"));
  EXPECT_TRUE(friction.is_algebraic());
  EXPECT_FALSE(CompiledFormula("sign(2*omega)", {}).has_direction());
}

TEST(CompiledFormula, KnowsWhatStandsInIt) {
  const CompiledFormula formula("-k*theta^3 + sin(2*t)", {"k"});
  EXPECT_TRUE(formula.uses("theta"));
  EXPECT_TRUE(formula.uses("t"));
  EXPECT_FALSE(formula.uses("omega"));
  EXPECT_FALSE(formula.uses("tau"));
  EXPECT_FALSE(formula.is_algebraic());
  EXPECT_TRUE(CompiledFormula("-(1.5e-1*theta)^3/2", {}).is_algebraic());
  EXPECT_FALSE(CompiledFormula("theta < 1 ? theta : 1", {}).is_algebraic());
}

TEST(CompiledFormula, GivesEveryThreadItsOwnVariables) {
  constexpr int kThreads = 8;
  constexpr int kCalls = 20000;
  const CompiledFormula formula("k*theta - omega", {"k"});
  std::vector<int> wrong(kThreads, 0);
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&formula, &wrong, i] {
      for (int call = 0; call < kCalls; ++call) {
        const double angle = i + 1e-3 * call;
        const double k = i + 1;
        const double value = formula({angle, 1.0 * call, 0.0, 0.0}, 1.0, std::vector{k});
        if (value != k * angle - 1.0 * call) ++wrong[static_cast<std::size_t>(i)];
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(kThreads, 0));
}

struct WrongFormula {
  const char* name;
  std::string text;
  std::vector<std::string> numbers;
  std::string error;
  std::string key = "";
};

void PrintTo(const WrongFormula& wrong, std::ostream* out) {
  *out << wrong.name;
}

const std::string kFormulaNames = "; allowed: theta, omega, tau, t, pi";
const std::string kOtherNumbers = "; a number of the law needs a key beside hub_torque";

const std::vector<WrongFormula> kWrongFormulas = {
    {"VariableMisspelt",
     "-k*thta^3",
     {"k"},
     "thta: unknown variable (did you mean theta?)" + kFormulaNames + ", k" + kOtherNumbers},
    {"GreekLetter",
     "-2*\xce\xb8",
     {},
     "\xce\xb8: unknown variable" + kFormulaNames + kOtherNumbers},
    {"ConstantOfTheParser",
     "_pi",
     {},
     "_pi: unknown variable (did you mean pi?)" + kFormulaNames + kOtherNumbers},
    {"ParenthesisOpen", "-2*(theta + 1", {}, "a parenthesis is not closed"},
    {"ParenthesisTooMany", "-2*theta)", {}, "cannot be read at character 9, )"},
    {"EndsEarly", "-2*", {}, "ends where a number, a variable or a function must follow"},
    {"Empty", "", {}, "ends where a number, a variable or a function must follow"},
    {"SignMissing", "2 theta", {}, "cannot be read at character 3, theta"},
    {"TwoSigns", "2*/theta", {}, "cannot be read at character 3, /theta"},
    {"Assignment", "k = 3", {"k"}, "= at character 3: a formula assigns nothing; equality is =="},
    {"Quotes", "'theta'", {}, "character 1, ': not allowed in a formula"},
    {"TwoValues", "theta, omega", {}, "has several values between commas; must have one"},
    {"TooManyArguments", "sin(theta, omega)", {}, "a function has too many arguments"},
    {"TooFewArguments", "atan2(theta)", {}, "a function has too few arguments"},
    {"NumberNotUsed", "-k*theta", {"c", "k"}, "does not stand in the formula", "c"},
    {"NumberNamedAsAVariable",
     "-tau",
     {"tau"},
     "a variable, constant or function of formulas has this name; a number needs another",
     "tau"},
    {"NumberNamedAsAFunction",
     "-abs*theta",
     {"abs"},
     "a variable, constant or function of formulas has this name; a number needs another",
     "abs"},
    {"NumberWithoutAName",
     "-k*theta",
     {"k/m"},
     "no name of a number; must be letters, digits and _, a letter first",
     "k/m"},
    {"NumberThatBeginsWithADigit",
     "-k*theta",
     {"2k"},
     "no name of a number; must be letters, digits and _, a letter first",
     "2k"}};

class FormulaMistake : public testing::TestWithParam<WrongFormula> {};

TEST_P(FormulaMistake, IsNamed) {
  try {
    const CompiledFormula formula(GetParam().text, GetParam().numbers);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), GetParam().error);
    EXPECT_EQ(error.key(), GetParam().key);
  }
}

INSTANTIATE_TEST_SUITE_P(, FormulaMistake, testing::ValuesIn(kWrongFormulas),
                         [](const auto& wrong) { return std::string(wrong.param.name); });

TEST(CompiledFormula, AnUnknownFunctionIsNamedWithWhatWasMeant) {
  try {
    const CompiledFormula formula("-sqr(theta)", {});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_TRUE(what.starts_with("sqr: unknown function (did you mean sqrt?); allowed: ")) << what;
    EXPECT_NE(what.find(", sqrt, "), std::string::npos) << what;
  }
}

TEST(CompiledFormula, MoreNumbersThanALawHasAreRefused) {
  std::string text = "theta";
  std::vector<std::string> numbers;
  for (int i = 0; i < 101; ++i) {
    numbers.push_back("a" + std::to_string(i));
    text += "+" + numbers.back();
  }
  try {
    const CompiledFormula formula(text, numbers);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "has 101 numbers of its own; must be 100 or fewer");
  }
}

}  // namespace
}  // namespace flexarm::arm
