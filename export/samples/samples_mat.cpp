#include "export/samples/sample_files.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/file_writing.hpp"
#include "measured/files/text_file.hpp"

#include <array>
#include <matio.h>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace flexarm::samples {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestMat_bytes = std::size_t{1} << 31U;
/// Without a date, so that the same samples give the same file.
constexpr const char* kMatHeader = "MATLAB 5.0 MAT-file, written by flexarm export";

struct CloseMat {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeMat {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};

[[noreturn]] void fail_to_write() {
  throw std::runtime_error("MATLAB file of samples: cannot be made");
}

/// A file that is removed again.
class ScratchFile {
 public:
  ScratchFile() : path_(measured::temporary_name(fs::temp_directory_path())) {}
  ~ScratchFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

class MatWriter {
 public:
  explicit MatWriter(const fs::path& path)
      : file_(Mat_CreateVer(path.c_str(), kMatHeader, MAT_FT_MAT5)) {
    if (!file_) fail_to_write();
  }

  /// Numbers in MATLAB's order: the first index runs fastest.
  void add(const char* name, std::vector<std::size_t> dimensions, std::vector<double> numbers) {
    const std::unique_ptr<matvar_t, FreeMat> variable(
        Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, static_cast<int>(dimensions.size()),
                      dimensions.data(), numbers.data(), 0));
    write(variable.get());
  }
  /// A column of texts, a cell array.
  void add(const char* name, const std::vector<std::string>& texts) {
    std::vector<matvar_t*> cells;
    for (const std::string& text : texts) {
      std::array<std::size_t, 2> size = {text.empty() ? 0U : 1U, text.size()};
      std::string copy = text;
      cells.push_back(
          Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF8, 2, size.data(), copy.data(), 0));
    }
    std::array<std::size_t, 2> size = {cells.size(), 1};
    const std::unique_ptr<matvar_t, FreeMat> variable(
        Mat_VarCreate(name, MAT_C_CELL, MAT_T_CELL, 2, size.data(), cells.data(), 0));
    write(variable.get());
  }
  void close() {
    if (Mat_Close(file_.release()) != 0) fail_to_write();
  }

 private:
  void write(matvar_t* variable) {
    if (variable == nullptr || Mat_VarWrite(file_.get(), variable, MAT_COMPRESSION_NONE) != 0) {
      fail_to_write();
    }
  }

  std::unique_ptr<mat_t, CloseMat> file_;
};

}  // namespace

void write_samples_mat(const SampleExport& exported, const fs::path& path) {
  const auto& samples = exported.samples;
  const auto& systems = exported.state_space.systems;
  const std::size_t count = systems.size();
  const ScratchFile scratch;
  MatWriter file(scratch.path());
  const auto stack = [&](const char* name, Eigen::MatrixXd response::StateSpace::*matrix) {
    std::vector<double> numbers;
    for (const response::StateSpace& system : systems) {
      const Eigen::MatrixXd& one = system.*matrix;
      numbers.insert(numbers.end(), one.data(), one.data() + one.size());
    }
    const Eigen::MatrixXd& first = systems.front().*matrix;
    file.add(
        name,
        {static_cast<std::size_t>(first.rows()), static_cast<std::size_t>(first.cols()), count},
        std::move(numbers));
  };
  stack("A", &response::StateSpace::a);
  stack("B", &response::StateSpace::b);
  stack("C", &response::StateSpace::c);
  stack("D", &response::StateSpace::d);
  std::vector<double> delays;
  std::vector<double> output_delays;
  std::vector<double> sets;
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) {
    const auto& of_outputs = systems[k].output_delay_s;
    delays.push_back(systems[k].delay_s);
    output_delays.insert(output_delays.end(), of_outputs.begin(), of_outputs.end());
    sets.push_back(static_cast<double>(samples.samples[k].set) + 1.0);
    const std::vector<double>& its = samples.samples[k].values;
    values.insert(values.end(), its.begin(), its.end());
  }
  const std::size_t outputs = output_delays.size() / count;
  file.add("delay_s", {1, count}, std::move(delays));
  file.add("output_delay_s", {outputs, count}, std::move(output_delays));
  file.add("states", exported.state_space.states);
  std::vector<std::string> names;
  std::vector<std::string> units;
  for (const arm::Sensor& sensor : systems.front().sensors) {
    names.push_back(arm::to_string(sensor));
    units.emplace_back(arm::unit(sensor));
  }
  file.add("sensors", std::exchange(names, {}));
  file.add("units", std::exchange(units, {}));
  for (const SampledNumber& number : samples.numbers) {
    names.push_back(number.key);
    units.push_back(number.unit);
  }
  file.add("values", {names.size(), count}, std::move(values));
  file.add("numbers", std::exchange(names, {}));
  file.add("number_units", std::exchange(units, {}));
  std::vector<double> probabilities;
  for (const ArmDistribution& set : exported.posterior.sets) {
    names.push_back(set.effects);
    probabilities.push_back(set.probability);
  }
  file.add("set", {1, count}, std::move(sets));
  file.add("sets", names);
  file.add("probability", {names.size(), 1}, std::move(probabilities));
  file.add("left_out_effects", exported.left_out_effects);
  file.add("seed", {1, 1}, {static_cast<double>(exported.seed)});
  file.close();
  measured::write_atomically(path, measured::read_text_file(scratch.path(), kLargestMat_bytes));
}

}  // namespace flexarm::samples
