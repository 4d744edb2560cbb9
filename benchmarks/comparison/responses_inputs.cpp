#include "benchmarks/comparison/inputs.hpp"
#include "benchmarks/comparison/raw_files.hpp"
#include "benchmarks/yardstick.hpp"
#include "response/state_space.hpp"

#include <vector>

namespace flexarm::benchmarks {

void write_responses(const std::filesystem::path& folder) {
  const exact_tf::ExactArm exact(damped_arm());
  const std::vector<arm::Sensor> sensors = {kHubAngle};
  std::vector<double> omega_rad_per_s;
  std::vector<double> real;
  std::vector<double> imaginary;
  const auto points = frequency_points();
  const auto values = responses(exact, kHubAngle, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    omega_rad_per_s.push_back(points[i].imag());
    real.push_back(values[i].real());
    imaginary.push_back(values[i].imag());
  }
  auto systems = nlohmann::json::array();
  for (const int modes : {10, 40, 160}) {
    const auto system = response::state_space(exact.modal_model(modes, sensors, {}), sensors);
    systems.push_back({{"modes", modes},
                       {"a", rows(system.a)},
                       {"b", rows(system.b)},
                       {"c", rows(system.c)},
                       {"d", rows(system.d)}});
  }
  write_json(folder / "responses.json", {{"omega_rad_per_s", omega_rad_per_s},
                                         {"real_rad_per_N_m", real},
                                         {"imaginary_rad_per_N_m", imaginary},
                                         {"systems", systems}});
}

}  // namespace flexarm::benchmarks
