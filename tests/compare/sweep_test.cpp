#include "arm/input_error.hpp"
#include "compare/features.hpp"
#include "compare/sweeps/sweep_checkpoint.hpp"
#include "compare/sweeps/sweep_result.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/settings.hpp"
#include "tests/compare/models.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace flexarm::compare {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Kind = SweepEvent::Kind;

class Sweep : public testing::Test {
 protected:
  Sweep() {
    std::string name = (fs::temp_directory_path() / "flexarm-sweep-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~Sweep() override { fs::remove_all(folder_); }

  fs::path checkpoint() const { return folder_ / "sweep.checkpoint"; }

  fs::path folder_;
};

SweepTask task_over(const std::vector<std::string>& axes, int models = 1) {
  SweepTask task;
  task.arm = arm::paper_arm();
  task.arm.payload.mass_kg = 0.05;
  for (const auto& text : axes) task.axes.push_back(parse_axis(text));
  task.models = standard_models(task.questions.poles);
  task.models.resize(static_cast<std::size_t>(models));
  return task;
}

SweepResult sweep(const SweepTask& task, const SweepRun& run = {},
                  const SweepTolerances& tolerances = {}) {
  return assemble(task, evaluate(task, run), run, tolerances);
}

/// Every number of a result, bit for bit.
std::string bytes_of(const SweepResult& result) {
  std::string bytes;
  const auto add = [&bytes](double value) {
    bytes += std::to_string(std::bit_cast<std::uint64_t>(value)) + " ";
  };
  for (const auto& curve : result.curves) {
    add(curve.number);
    for (const auto& of_model : curve.s_rad_per_s) {
      for (const auto& s : of_model) {
        add(s ? s->real() : -1.0);
        add(s ? s->imag() : -1.0);
      }
    }
  }
  for (const auto& table : {result.modes.hub_slope, result.modes.tip_value_m}) {
    for (const auto& of_model : table) {
      for (const auto& of_order : of_model) std::ranges::for_each(of_order, add);
    }
  }
  for (const auto& event : result.events) {
    add(static_cast<double>(event.kind));
    add(event.track);
    add(event.from_value);
    add(event.to_value);
  }
  for (const auto& row : result.agreement) add(row.worst);
  return bytes;
}

std::vector<SweepCurve> tip_curves(const SweepResult& result) {
  std::vector<SweepCurve> curves;
  for (const auto& curve : result.curves) {
    if (curve.family.zeros_of == kTipAcceleration) curves.push_back(curve);
  }
  return curves;
}

TEST_F(Sweep, PolesAreThoseOfTheModelAtEachPoint) {
  const auto task = task_over({"payload.mass=0:0.2:5"});
  const auto result = sweep(task);
  arm::Arm arm = task.arm;
  arm.payload.mass_kg = 0.15;
  const auto poles = exact_tf::ExactArm(arm).poles(task.questions.poles);
  for (std::size_t k = 0; k < poles.omega_rad_per_s.size(); ++k) {
    EXPECT_EQ(result.curves[k].number, static_cast<int>(k) + 1);
    // The grid's 0.15 may differ from this one by an ulp.
    EXPECT_NEAR(result.curves[k].s_rad_per_s[0][3]->imag(), poles.omega_rad_per_s[k],
                1e-14 * poles.omega_rad_per_s[k]);
  }
}

TEST_F(Sweep, TheImaginaryTipZeroOfAPayloadInertiaCrossesTheRealOnes) {
  const auto result = sweep(task_over({"payload.inertia=0:0.002:9"}));
  const auto curves = tip_curves(result);
  ASSERT_EQ(curves.size(), 5);
  for (std::size_t k = 0; k < 4; ++k) {
    for (const auto& s : curves[k].s_rad_per_s[0]) {
      ASSERT_TRUE(s);
      EXPECT_EQ(s->imag(), 0.0);
    }
  }
  const auto& imaginary = curves[4].s_rad_per_s[0];
  EXPECT_FALSE(imaginary[0]);  // without payload inertia it is at infinity
  for (std::size_t j = 1; j < imaginary.size(); ++j) {
    ASSERT_TRUE(imaginary[j]);
    EXPECT_EQ(imaginary[j]->real(), 0.0);
    if (j == 1) continue;
    EXPECT_LT(imaginary[j]->imag(), imaginary[j - 1]->imag());
  }
  // It begins among the largest and ends below the second: its place in the list changes.
  EXPECT_GT(std::abs(*imaginary[1]), std::abs(*curves[1].s_rad_per_s[0][1]));
  EXPECT_LT(std::abs(*imaginary[8]), std::abs(*curves[1].s_rad_per_s[0][8]));
  ASSERT_EQ(result.events.size(), 1);
  EXPECT_EQ(result.events[0].kind, Kind::appears_beyond);
  EXPECT_EQ(result.events[0].track, 5);
}

TEST_F(Sweep, DampedPolesHaveTheNumbersOfTheUndampedOnesBesideThem) {
  // A spring holds the hub: its lowest pole is no flexible one. Friction that grows makes two real
  // poles of it, and of another one.
  auto task = task_over({"effects.hub_viscous_friction.coefficient=log:1e-3:1:9"});
  effects::put(task.arm, "hub_spring", {{"stiffness", 5.0}});
  task.questions.modes = true;
  const auto result = sweep(task);
  std::vector<int> numbers;
  for (const auto& curve : result.curves) {
    if (!curve.family.damped) continue;
    numbers.push_back(curve.number);
    if (curve.number < 1 || curve.number > task.questions.poles) continue;
    const auto& undamped = result.curves[static_cast<std::size_t>(curve.number) - 1];
    const double omega = undamped.s_rad_per_s[0][0]->imag();
    EXPECT_NEAR(std::abs(*curve.s_rad_per_s[0][0]), omega, 0.01 * omega);
  }
  EXPECT_EQ(numbers.front(), 0);
  EXPECT_TRUE(std::ranges::is_sorted(numbers));
  EXPECT_EQ(std::ranges::adjacent_find(numbers), numbers.end()) << "none twice";
  for (const auto& event : result.events) {
    if (!event.family.damped) continue;
    EXPECT_TRUE(std::ranges::find(numbers, event.track) != numbers.end());
  }
}

TEST_F(Sweep, TracksAreContinuousWhateverTheGrid) {
  // The same curve through nine times as many points.
  const auto coarse = tip_curves(sweep(task_over({"payload.inertia=1e-5:0.02:5"})));
  const auto fine = tip_curves(sweep(task_over({"payload.inertia=1e-5:0.02:37"})));
  ASSERT_EQ(coarse.size(), fine.size());
  for (std::size_t t = 0; t < coarse.size(); ++t) {
    for (std::size_t j = 0; j < 5; ++j) {
      const auto& a = coarse[t].s_rad_per_s[0][j];
      const auto& b = fine[t].s_rad_per_s[0][9 * j];
      ASSERT_EQ(a.has_value(), b.has_value());
      if (!a) continue;
      EXPECT_LT(relative_distance(*a, *b), 1e-12) << t << " " << j;
    }
    const auto& curve = fine[t].s_rad_per_s[0];
    for (std::size_t j = 2; j < curve.size(); ++j) {
      if (!curve[j] || !curve[j - 1]) continue;
      EXPECT_LT(relative_distance(*curve[j], *curve[j - 1]), 0.5);
    }
  }
}

TEST_F(Sweep, DampedPolesAreFollowedThroughCriticalDamping) {
  auto task = task_over({"hub.viscous_friction=log:1e-3:1:401"});
  task.arm.payload = {};
  task.arm.damping.kelvin_voigt_s = 1e-4;
  const auto result = sweep(task);
  int becoming_real = 0;
  for (const auto& curve : result.curves) {
    if (!curve.family.damped) continue;
    const auto& poles = curve.s_rad_per_s.front();
    bool was_complex = false;
    bool became_real = false;
    for (std::size_t j = 0; j < poles.size(); ++j) {
      if (!poles[j]) continue;
      became_real = became_real || (was_complex && poles[j]->imag() == 0.0);
      was_complex = was_complex || poles[j]->imag() > 0.0;
      if (j == 0 || !poles[j - 1]) continue;
      // Friction grows by 1.7 % from point to point; where two poles meet they move with the root
      // of that.
      EXPECT_LT(relative_distance(*poles[j], *poles[j - 1]), 2.0 * std::sqrt(0.017))
          << curve.number << " " << j;
    }
    if (became_real) ++becoming_real;
  }
  EXPECT_EQ(becoming_real, 1);
  // A pair parts on the real axis; the slower of the two meets the pole of the hub's friction.
  ASSERT_EQ(result.events.size(), 2);
  const auto& parting = result.events[0].kind == Kind::part ? result.events[0] : result.events[1];
  const auto& meeting = result.events[0].kind == Kind::part ? result.events[1] : result.events[0];
  EXPECT_EQ(parting.kind, Kind::part);
  EXPECT_EQ(meeting.kind, Kind::meet);
  EXPECT_TRUE(parting.family.damped);
  EXPECT_LT(parting.to_value, meeting.from_value);
  EXPECT_TRUE(meeting.track == parting.track || meeting.other == parting.track ||
              meeting.track == parting.other || meeting.other == parting.other);
}

TEST_F(Sweep, AnUndampedSweepHasNoDampedPoles) {
  for (const auto& curve : sweep(task_over({"payload.mass=0,0.1"})).curves) {
    EXPECT_FALSE(curve.family.damped);
  }
  // One damped point is enough.
  auto from_zero = task_over({"damping.kelvin_voigt=0.0,1e-4"});
  const auto result = sweep(from_zero);
  const auto damped =
      std::ranges::count_if(result.curves, [](const auto& curve) { return curve.family.damped; });
  EXPECT_EQ(damped, from_zero.questions.poles);
  EXPECT_TRUE(result.events.empty());
}

TEST_F(Sweep, RowsOfATwoParameterGridShareTheirTracks) {
  auto task = task_over({"payload.mass=0.02:0.3:4", "payload.inertia=1e-5:0.004:7"});
  const auto result = sweep(task);
  const auto curves = tip_curves(result);
  for (const auto& curve : curves) {
    bool real = false;
    bool imaginary = false;
    for (const auto& s : curve.s_rad_per_s[0]) {
      if (!s) continue;
      real = real || s->imag() == 0.0;
      imaginary = imaginary || s->real() == 0.0;
    }
    EXPECT_NE(real, imaginary) << "track " << curve.number;
  }
  for (const auto& event : result.events) EXPECT_NE(event.kind, Kind::seam);
  // The grid's rows are sweeps of their own.
  std::swap(task.axes[0], task.axes[1]);
  const auto turned = sweep(task);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(result.curves[k].s_rad_per_s[0][2 * 7 + 3],
              turned.curves[k].s_rad_per_s[0][3 * 4 + 2]);
  }
}

TEST_F(Sweep, TheResultDoesNotDependOnTheNumberOfThreads) {
  const auto task = task_over({"hub.inertia=log:1e-4:1e-2:4", "payload.inertia=0:0.002:6"}, 3);
  const auto bytes_with = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    return arena.execute([&] { return bytes_of(sweep(task)); });
  };
  const std::string one = bytes_with(1);
  for (const int threads : {2, 7}) EXPECT_EQ(bytes_with(threads), one) << threads;
}

TEST_F(Sweep, ThreeFormulationsAgreeOverTheGrid) {
  auto task = task_over({"payload.mass=0:0.5:4", "payload.inertia=0,1e-4,1e-3"}, 3);
  task.arm.damping.kelvin_voigt_s = 1e-4;
  const auto result = sweep(task);
  ASSERT_EQ(result.agreement.size(), 2 * (1 + 2 + 3));
  for (const auto& row : result.agreement) {
    EXPECT_TRUE(row.agrees()) << row.quantity << " " << row.model << " " << row.worst << " "
                              << row.missing;
    EXPECT_GT(row.compared, 0);
  }
}

TEST_F(Sweep, ACoarseModelIsFoundOutAndWhere) {
  auto task = task_over({"payload.mass=0:0.5:4"});
  fem::FemArm::Options coarse;
  coarse.mesh.elements = 3;
  coarse.degree = 3;
  task.models.push_back({"fem", response::describe(coarse),
                         [coarse](const arm::Arm& arm) { return fem::FemArm(arm, coarse); }});
  const auto result = sweep(task);
  const auto& poles = result.agreement.front();
  EXPECT_EQ(poles.quantity, "poles");
  EXPECT_FALSE(poles.agrees());
  EXPECT_GT(poles.worst, 1e-3);
  EXPECT_EQ(poles.worst_number, task.questions.poles);
  EXPECT_LT(poles.worst_point, task.points());
  const auto tip =
      std::ranges::find(result.agreement, "tip_acceleration zeros", &SweepAgreement::quantity);
  EXPECT_FALSE(tip->agrees());
}

TEST_F(Sweep, GoesOnAfterAnInterruptionToTheSameBytes) {
  const auto task = task_over({"payload.inertia=0:0.002:40"}, 3);
  const std::string expected = bytes_of(sweep(task));

  std::atomic<bool> stop = false;
  std::atomic<int> done = 0;
  SweepRun run;
  run.checkpoint = checkpoint();
  run.program_version = "test";
  run.stop = &stop;
  run.progress = [&] {
    if (++done == 13) stop = true;
  };
  EXPECT_THROW(evaluate(task, run), SweepInterrupted);
  ASSERT_TRUE(fs::exists(checkpoint()));

  stop = false;
  run.resume = true;
  run.progress = nullptr;
  auto values = evaluate(task, run);
  EXPECT_GE(values.resumed, 13);
  EXPECT_LT(values.resumed, 40);
  EXPECT_EQ(bytes_of(assemble(task, std::move(values), run, {})), expected);
}

TEST_F(Sweep, ACheckpointOfAnotherSweepIsRefusedByName) {
  const auto task = task_over({"payload.mass=0:0.2:5"});
  SweepRun run;
  run.checkpoint = checkpoint();
  run.checkpoint_interval_s = 0.0;
  run.program_version = "test";
  evaluate(task, run);
  run.resume = true;
  EXPECT_EQ(evaluate(task, run).resumed, 5);

  const auto refusal = [&](const SweepTask& other, const SweepRun& with) -> std::string {
    try {
      evaluate(other, with);
    } catch (const arm::InputError& error) {
      return error.what();
    }
    return "not refused";
  };
  EXPECT_EQ(refusal(task_over({"payload.mass=0:0.2:6"}), run),
            checkpoint().string() +
                ": checkpoint of another sweep: grid is \"payload.mass=0:0.2:5\", not "
                "\"payload.mass=0:0.2:6\"");
  auto other_arm = task;
  other_arm.arm.hub.inertia_kg_m2 *= 2.0;
  EXPECT_THAT(refusal(other_arm, run), HasSubstr("checkpoint of another sweep: arm is"));
  EXPECT_THAT(refusal(task_over({"payload.mass=0:0.2:5"}, 2), run), HasSubstr("models is"));
  auto other_questions = task;
  other_questions.questions.zeros = 3;
  EXPECT_THAT(refusal(other_questions, run), HasSubstr("questions is"));
  SweepRun other_version = run;
  other_version.program_version = "newer";
  EXPECT_THAT(refusal(task, other_version), HasSubstr("version is"));

  fs::resize_file(checkpoint(), fs::file_size(checkpoint()) - 8);
  EXPECT_THAT(refusal(task, run), HasSubstr("not a valid sweep checkpoint"));
  std::ofstream(checkpoint()) << "not a checkpoint\n";
  EXPECT_THAT(refusal(task, run), HasSubstr("not a valid sweep checkpoint"));
  fs::remove(checkpoint());
  EXPECT_THAT(refusal(task, run), HasSubstr("no checkpoint found"));
}

TEST_F(Sweep, TheFirstPointThatAModelRefusesIsNamedWhateverTheThreads) {
  auto task = task_over({"payload.mass=0:0.4:41"});
  const auto make = task.models.front().make;
  task.models.front().make = [make](const arm::Arm& arm) {
    if (arm.payload.mass_kg > 0.1 && arm.payload.mass_kg < 0.3) {
      throw arm::InputError("no model between 0.1 and 0.3 kg");
    }
    return make(arm);
  };
  for (const int threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    try {
      evaluate(task, {});
      ADD_FAILURE() << "not refused";
    } catch (const arm::InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith("at payload.mass = 0.11"));
    }
  }
}

}  // namespace
}  // namespace flexarm::compare
