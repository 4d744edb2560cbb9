#include "tests/app/flexarm_fixture.hpp"
#include "tests/app/process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <regex>
#include <string>

namespace flexarm::testing_app {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// What a shell command prints; `flexarm` is the program.
std::string printed_by(const std::string& command) {
  return shell_output("PATH=$(dirname " FLEXARM_PROGRAM "):$PATH; export PATH; " + command +
                      " 2>&1");
}

/// What bash offers for the last of `words`, one a line.
std::string bash_offers(const std::string& words) {
  return printed_by(
      "bash -c 'compopt() { echo \"compopt $*\"; }; source <(flexarm completion bash); "
      "COMP_WORDS=(" +
      words +
      "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _flexarm; printf \"%s\\n\" \"${COMPREPLY[@]}\"'");
}

std::string fish_offers(const std::string& line) {
  return printed_by("fish -c 'flexarm completion fish | source; complete -C \"" + line + "\"'");
}

TEST(Completion, BashOffersCommandsOptionsAndWords) {
  EXPECT_EQ(bash_offers("flexarm comp"), "compare\ncompletion\n");
  EXPECT_EQ(bash_offers("flexarm modes --pay"), "--payload-mass\n--payload-inertia\n");
  EXPECT_EQ(bash_offers("flexarm modes --formulation f"), "fem\n");
  EXPECT_EQ(bash_offers("flexarm modes --formulation = f"), "fem\n");
  EXPECT_EQ(bash_offers("flexarm effects coul"), "coulomb_friction\n");
  EXPECT_EQ(bash_offers("flexarm completion \"\""), "bash\nzsh\nfish\n");
}

TEST(Completion, BashCompletesTheLastWordOfAList) {
  EXPECT_EQ(bash_offers("flexarm modes --sensor hub_angle,tip_a"), "hub_angle,tip_acceleration\n");
}

TEST(Completion, BashOffersFilesAndFoldersAndNothingForANumber) {
  EXPECT_THAT(bash_offers("flexarm modes rig"), StartsWith("compopt -o default\n"));
  EXPECT_THAT(bash_offers("flexarm modes --json x"), StartsWith("compopt -o default\n"));
  EXPECT_THAT(bash_offers("flexarm modes --out x"), StartsWith("compopt -o dirnames\n"));
  EXPECT_EQ(bash_offers("flexarm modes --hub-inertia 0"), "\n");
}

TEST(Completion, FishOffersCommandsOptionsAndWords) {
  EXPECT_THAT(
      fish_offers("flexarm comp"),
      AllOf(HasSubstr("compare\tCompare the three formulations"), HasSubstr("completion\t")));
  EXPECT_THAT(fish_offers("flexarm modes --pay"), HasSubstr("--payload-mass\t"));
  EXPECT_THAT(fish_offers("flexarm modes --formulation "), HasSubstr("assumed_modes\t"));
  EXPECT_THAT(fish_offers("flexarm modes --sensor hub_angle,tip_a"),
              HasSubstr("hub_angle,tip_acceleration\t"));
  EXPECT_THAT(fish_offers("flexarm effects coul"), HasSubstr("coulomb_friction"));
}

TEST(Completion, ZshReadsItsScript) {
  EXPECT_EQ(printed_by("flexarm completion zsh | zsh -n && echo read"), "read\n");
  // `_arguments` takes a specification an option; a stand-in prints them.
  EXPECT_THAT(printed_by("zsh -f -c 'compdef() { }; source <(flexarm completion zsh); "
                         "_arguments() { print -rl -- $@; [[ $1 != -C ]] || { state=argument; "
                         "return 1 } }; words=(modes); _flexarm'"),
              AllOf(HasSubstr(":value:(exact_tf fem assumed_modes)\n"), HasSubstr("\n*--sensor["),
                    HasSubstr("\n*:ARM:_files\n"), HasSubstr("instead of that in the file]")));
}

TEST_F(Flexarm, CompletionOfAnotherShellIsRefused) {
  expect_refused(run({"completion", "bahs"}),
                 "completion bahs: must be bash or zsh or fish (did you mean bash?)");
}

TEST_F(Flexarm, ManualPagesHaveEachOptionOfTheHelp) {
  ASSERT_EQ(run({"manual-pages", "pages"}).status, 0);
  EXPECT_THAT(run({"--help"}).output, Not(HasSubstr("manual-pages")));
  const auto pages = names_in("pages");
  EXPECT_THAT(pages, AllOf(testing::Contains("flexarm.1"), testing::Contains("flexarm-compare.1"),
                           Not(testing::Contains("flexarm-manual-pages.1"))));
  const std::string compare = text_of("pages/flexarm-compare.1");
  const std::string help = run({"compare", "--help"}).output;
  const std::regex option("\n *(?:-[A-Za-z], )?(--[A-Za-z-]+)");
  ASSERT_GT(std::distance(std::sregex_iterator(help.begin(), help.end(), option), {}), 9);
  for (std::sregex_iterator found(help.begin(), help.end(), option), end; found != end; ++found) {
    const std::string name = std::regex_replace((*found)[1].str(), std::regex("-"), "\\-");
    EXPECT_THAT(compare, HasSubstr("\\fB" + name + "\\fR"));
  }
  EXPECT_THAT(compare, AllOf(HasSubstr("\\fB\\-\\-payload\\-mass\\fR \\fINUMBER,...\\fR\n"),
                             HasSubstr(".SH EXIT STATUS\n"), HasSubstr(".SH EXAMPLE\n"),
                             HasSubstr("flexarm compare rig.toml \\-\\-poles 6")));
  EXPECT_THAT(text_of("pages/flexarm.1"), HasSubstr("\\fBflexarm\\-diagnose\\fR(1)"));
}

TEST_F(Flexarm, ManualPageHasItsHeadingsAndNoSentenceAmongThem) {
  ASSERT_EQ(run({"manual-pages", "pages"}).status, 0);
  const auto headings_of = [this](const std::string& page) {
    const std::string text = text_of("pages/" + page);
    const std::regex heading("(?:^|\n)\\.SH ([^\n]*)");
    std::vector<std::string> found;
    for (std::sregex_iterator at(text.begin(), text.end(), heading), end; at != end; ++at) {
      found.push_back((*at)[1].str());
    }
    return found;
  };
  EXPECT_THAT(headings_of("flexarm.1"),
              testing::ElementsAre("NAME", "SYNOPSIS", "DESCRIPTION", "COMMANDS", "OPTIONS",
                                   "TYPICAL SESSION", "NUMBERS", "HELP", "EXIT STATUS"));
  EXPECT_THAT(headings_of("flexarm-diagnose.1"),
              testing::ElementsAre("NAME", "SYNOPSIS", "ARGUMENTS", "OPTIONS", "VERDICTS",
                                   "EXAMPLE", "SEE ALSO"));
  EXPECT_THAT(headings_of("flexarm-completion.1"),
              testing::ElementsAre("NAME", "SYNOPSIS", "ARGUMENTS", "OPTIONS", "START FILES",
                                   "EXAMPLE", "SEE ALSO"));
}

}  // namespace
}  // namespace flexarm::testing_app
