#include "report/terminal.hpp"

#include "tests/environment_variable.hpp"
#include "tests/report/pseudo_terminal.hpp"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <string>
#include <sys/ioctl.h>
#include <unistd.h>

namespace flexarm::report {
namespace {

using testing_environment::EnvironmentVariable;

/// A descriptor that is no terminal.
class Pipe {
 public:
  Pipe() : descriptor_(::open("/dev/null", O_WRONLY | O_CLOEXEC)) {}
  ~Pipe() { ::close(descriptor_); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

TEST(OutputWidth, IsThatOfTheTerminalWhateverColumnsSays) {
  const PseudoTerminal terminal(37);
  const EnvironmentVariable columns("COLUMNS", "90");
  EXPECT_EQ(output_width(terminal.descriptor()), 37U);
}

TEST(OutputWidth, IsNeverTooNarrowToWriteIn) {
  const PseudoTerminal terminal(5);
  EXPECT_EQ(output_width(terminal.descriptor()), kLeastWidth);
}

TEST(OutputWidth, OfATerminalWithoutASizeIsThatOfColumns) {
  const PseudoTerminal terminal(0);
  const EnvironmentVariable columns("COLUMNS", "64");
  EXPECT_EQ(output_width(terminal.descriptor()), 64U);
}

TEST(OutputWidth, OfAPipeIsThatOfColumnsOrFixed) {
  const Pipe pipe;
  {
    const EnvironmentVariable columns("COLUMNS", "72");
    EXPECT_EQ(output_width(pipe.descriptor()), 72U);
  }
  for (const char* unusable : {"", "0", "-3", "80x", "wide", "99999999"}) {
    const EnvironmentVariable columns("COLUMNS", unusable);
    EXPECT_EQ(output_width(pipe.descriptor()), kPipeWidth) << unusable;
  }
  const EnvironmentVariable columns("COLUMNS", nullptr);
  EXPECT_EQ(output_width(pipe.descriptor()), kPipeWidth);
}

TEST(Colour, IsForTerminalsAlone) {
  const EnvironmentVariable no_colour("NO_COLOR", nullptr);
  const PseudoTerminal terminal(80);
  const Pipe pipe;
  EXPECT_TRUE(shows_colour(terminal.descriptor()));
  EXPECT_FALSE(shows_colour(pipe.descriptor()));
}

TEST(Colour, IsSwitchedOffByNoColorUnlessThatIsEmpty) {
  const PseudoTerminal terminal(80);
  for (const char* value : {"1", "0", "no"}) {
    const EnvironmentVariable no_colour("NO_COLOR", value);
    EXPECT_FALSE(shows_colour(terminal.descriptor())) << value;
  }
  const EnvironmentVariable no_colour("NO_COLOR", "");
  EXPECT_TRUE(shows_colour(terminal.descriptor()));
}

TEST(Colour, IsNotForDumbTerminals) {
  const EnvironmentVariable no_colour("NO_COLOR", nullptr);
  const PseudoTerminal terminal(80);
  for (const char* value : {static_cast<const char*>(nullptr), "", "dumb"}) {
    const EnvironmentVariable kind("TERM", value);
    EXPECT_FALSE(shows_colour(terminal.descriptor()));
  }
}

}  // namespace
}  // namespace flexarm::report
