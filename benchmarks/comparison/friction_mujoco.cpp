// A second with Coulomb friction at the hub in MuJoCo: the beam as a chain of rigid links. Each
// link of length h = l/n is joined to the next by a spring EI/h and a dashpot kv EI/h; half a link
// is fixed to the hub and half a link ends the chain. Friction is the joint's frictionloss, a
// constraint that MuJoCo softens.
//
// Beside it flexarm with ten modes. Errors are those of hub angle and hub velocity against flexarm
// with 40 modes and smaller steps, relative to the peak.
//
// friction_mujoco ROWS
#include "benchmarks/comparison/friction_case.hpp"
#include "benchmarks/comparison/raw_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <mujoco/mujoco.h>
#include <span>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

namespace {

using namespace flexarm;

constexpr int kModes = 10;
constexpr int kReferenceModes = 40;
constexpr int kRepetitions = 3;
constexpr double kLong_s = 3.0;  ///< is not repeated

struct HubMotion {
  std::vector<double> angle_rad;
  std::vector<double> velocity_rad_per_s;
};

struct Chain {
  int links;
  int steps_per_sample;
  bool soft;  ///< MuJoCo's own constants of the friction constraint
};

/// Of the steps of a sample, the constants that soften the constraint least: its time constant is
/// two steps, below which MuJoCo does not go, and its impedance is nearly 1.
std::string friction_attributes(const Chain& chain, double timestep_s) {
  if (chain.soft) return "";
  return fmt::format("solreffriction=\"{} 1\" solimpfriction=\"0.9999 0.9999 0.001\"",
                     2.0 * timestep_s);
}

std::string link_text(double linear_density_kg_per_m, double length_m) {
  const double mass_kg = linear_density_kg_per_m * length_m;
  const double inertia_kg_m2 = mass_kg * length_m * length_m / 12.0;
  return fmt::format("<inertial pos=\"{} 0 0\" mass=\"{}\" diaginertia=\"{} {} {}\"/>",
                     length_m / 2.0, mass_kg, inertia_kg_m2, inertia_kg_m2, inertia_kg_m2);
}

std::string model_text(const arm::Arm& arm, const Chain& chain, double timestep_s) {
  const double link_m = arm.beam.length_m / chain.links;
  const double density = arm.beam.linear_density_kg_per_m();
  const double stiffness_N_m = arm.beam.flexural_rigidity_N_m2() / link_m;
  std::string text = fmt::format(
      "<mujoco><option timestep=\"{}\" gravity=\"0 0 0\" solver=\"Newton\" tolerance=\"1e-12\">"
      "<flag contact=\"disable\"/></option><worldbody><body>"
      "<joint type=\"hinge\" axis=\"0 0 1\" armature=\"{}\" damping=\"{}\" frictionloss=\"{}\" "
      "{}/>",
      timestep_s, arm.hub.inertia_kg_m2, arm.hub.viscous_friction_N_m_s_per_rad,
      benchmarks::kCoulombTorque_N_m, friction_attributes(chain, timestep_s));
  text += link_text(density, link_m / 2.0);
  for (int i = 1; i <= chain.links; ++i) {
    text += fmt::format(
        "<body pos=\"{} 0 0\"><joint type=\"hinge\" axis=\"0 0 1\" stiffness=\"{}\" "
        "damping=\"{}\"/>",
        i == 1 ? link_m / 2.0 : link_m, stiffness_N_m, arm.damping.kelvin_voigt_s * stiffness_N_m);
    text += link_text(density, i == chain.links ? link_m / 2.0 : link_m);
  }
  for (int i = 0; i <= chain.links; ++i) text += "</body>";
  return text + "</worldbody></mujoco>";
}

using Model = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;
using Data = std::unique_ptr<mjData, decltype(&mj_deleteData)>;

Model loaded(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() /
                    fmt::format("flexarm-chain-{}.xml", static_cast<long>(::getpid()));
  std::ofstream(path) << text;
  std::array<char, 1000> error = {};
  Model model(mj_loadXML(path.c_str(), nullptr, error.data(), static_cast<int>(error.size())),
              &mj_deleteModel);
  std::filesystem::remove(path);
  if (!model) throw std::runtime_error(error.data());
  return model;
}

HubMotion by_mujoco(const mjModel& model, const Chain& chain, std::span<const double> torque_N_m) {
  const Data data(mj_makeData(&model), &mj_deleteData);
  HubMotion made;
  for (const double torque : torque_N_m) {
    made.angle_rad.push_back(data->qpos[0]);
    made.velocity_rad_per_s.push_back(data->qvel[0]);
    data->qfrc_applied[0] = torque;
    for (int i = 0; i < chain.steps_per_sample; ++i) mj_step(&model, data.get());
  }
  return made;
}

HubMotion by_flexarm(const benchmarks::FrictionCase& friction, int substeps) {
  auto made = response::simulate(
      friction.timed.model, friction.parts, friction.timed.sensors, friction.timed.torque_N_m,
      {.sample_time_s = friction.timed.sample_time_s, .substeps = substeps, .energy = false});
  return {std::move(made.channels[0]), std::move(made.channels[1])};
}

/// Runs and prints one simulation.
template <class Run>
nlohmann::json row(const std::string& work, const HubMotion& exact, const Run& run) {
  double least_s = std::numeric_limits<double>::infinity();
  HubMotion made;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    const std::clock_t begin = std::clock();
    made = run();
    const double spent_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    least_s = std::min(least_s, spent_s);
    if (spent_s > kLong_s) break;
  }
  const double angle = benchmarks::relative_difference(made.angle_rad, exact.angle_rad);
  const double velocity =
      benchmarks::relative_difference(made.velocity_rad_per_s, exact.velocity_rad_per_s);
  fmt::print("{:<64} {:>9.4g} ms  error {:.3g}  error_of_angle {:.3g}\n", work, 1e3 * least_s,
             std::max(angle, velocity), angle);
  std::fflush(stdout);
  return {{"work", work},
          {"processor_s", least_s},
          {"error", std::max(angle, velocity)},
          {"error_of_angle", angle}};
}

int measure(const std::filesystem::path& rows_file) {
  const auto friction = benchmarks::friction_case(kModes);
  const auto exact =
      by_flexarm(benchmarks::friction_case(kReferenceModes), benchmarks::kReferenceSubsteps);
  auto rows = nlohmann::json::array();
  rows.push_back(
      row(fmt::format("flexarm modes:{}", kModes), exact, [&] { return by_flexarm(friction, 0); }));
  for (const Chain& chain : {Chain{20, 1, true}, Chain{10, 1, false}, Chain{20, 1, false},
                             Chain{40, 2, false}, Chain{80, 8, false}}) {
    const double timestep_s = friction.timed.sample_time_s / chain.steps_per_sample;
    const Model model = loaded(model_text(friction.timed.arm, chain, timestep_s));
    rows.push_back(row(fmt::format("links:{} steps:{} {}", chain.links, chain.steps_per_sample,
                                   chain.soft ? "soft" : "stiff"),
                       exact, [&] { return by_mujoco(*model, chain, friction.timed.torque_N_m); }));
  }
  benchmarks::write_json(rows_file,
                         {{"tool", fmt::format("MuJoCo {}", mj_versionString())}, {"rows", rows}});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: friction_mujoco ROWS\n");
    return 2;
  }
  try {
    return measure(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "friction_mujoco: {}\n", error.what());
    return 1;
  }
}
