#include "tests/trials/element_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

namespace flexarm::trials {

namespace {

/// Gauss and Legendre's of four places, exact for the squares of cubics.
struct GaussPlace {
  double part;
  double weight;
};
constexpr std::array<GaussPlace, 4> kGauss = {{{0.06943184420297371, 0.17392742256872693},
                                               {0.33000947820757187, 0.32607257743127307},
                                               {0.66999052179242813, 0.32607257743127307},
                                               {0.93056815579702629, 0.17392742256872693}}};

/// Two places nearer than this part of the beam are one.
constexpr double kSamePlace = 1e-9;

void add(std::vector<Eigen::Triplet<double>>& terms,
         const std::vector<std::pair<Eigen::Index, double>>& places,
         const Eigen::MatrixXd& square) {
  for (Eigen::Index i = 0; i < square.rows(); ++i) {
    for (Eigen::Index j = 0; j < square.cols(); ++j) {
      const auto& [row, row_factor] = places[static_cast<std::size_t>(i)];
      const auto& [column, column_factor] = places[static_cast<std::size_t>(j)];
      const double value = square(i, j) * row_factor * column_factor;
      if (value != 0.0) {
        terms.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
      }
    }
  }
}

/// k (u_a + factor u_b)^2.
void add_square(std::vector<Eigen::Triplet<double>>& terms, double k, Eigen::Index a,
                Eigen::Index b, double factor) {
  add(terms, {{a, 1.0}, {b, factor}}, k * Eigen::Matrix2d::Ones());
}

/// k a b^T of sparse rows.
void add_product(std::vector<Eigen::Triplet<double>>& terms, double k, const Eigen::VectorXd& a,
                 const Eigen::VectorXd& b) {
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (a(i) == 0.0) continue;
    for (Eigen::Index j = 0; j < b.size(); ++j) {
      if (b(j) == 0.0) continue;
      terms.emplace_back(static_cast<int>(i), static_cast<int>(j), k * a(i) * b(j));
    }
  }
}

Eigen::SparseMatrix<double> assembled(Eigen::Index size,
                                      const std::vector<Eigen::Triplet<double>>& terms) {
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(terms.begin(), terms.end());
  return matrix;
}

}  // namespace

std::complex<double> ReadingRow::of(const Eigen::VectorXcd& u, std::complex<double> s) const {
  const auto product = [&](const Eigen::VectorXd& row) {
    return row.cast<std::complex<double>>().cwiseProduct(u).sum();
  };
  return (product(stiffness) + s * product(damping) + s * s * product(mass)) /
         (1.0 + kelvin_voigt_s * s);
}

double ReadingRow::of_mode(const Eigen::VectorXd& u, double lambda) const {
  return stiffness.dot(u) - lambda * mass.dot(u);
}

ElementModel::ElementModel(const TrueArm& arm, int elements, std::span<const arm::Sensor> sensors)
    : arm_(arm) {
  lay_out(elements, sensors);
  Terms mass;
  Terms stiffness;
  Terms damping;
  for (const Element& element : elements_) {
    const Square square = square_of(element);
    add(mass, element.places, square.mass);
    add(stiffness, element.places, square.stiffness);
    add(damping, element.places, square.damping);
  }
  const auto add_one = [](Terms& terms, double k, Eigen::Index at) {
    terms.emplace_back(static_cast<int>(at), static_cast<int>(at), k);
  };
  const double rotor_share = arm.gear ? arm.gear->rotor_share : 1.0;
  add_one(mass, rotor_share * arm.hub_inertia_kg_m2, kHub);
  add_one(mass, (1.0 - rotor_share) * arm.hub_inertia_kg_m2, load_);
  add_one(stiffness, arm.hub_spring_N_m_per_rad, kHub);
  add_one(stiffness, hub_stiffness_N_m(), load_);
  add_one(damping, arm.hub_damping_N_m_s_per_rad, kHub);
  add_square(mass, arm.payload_kg, tip_deflection_, tip_rotation_, arm.payload_offset_m);
  add_one(mass, arm.payload_inertia_kg_m2, tip_rotation_);
  add_one(stiffness, tip_stiffness_N_m(), tip_rotation_);
  for (const Stretch& one : stretches_) {
    add_square(stiffness, one.stiffness_N_m_per_rad, one.beyond, one.before, -1.0);
    add_square(damping, one.damping_N_m_s_per_rad, one.beyond, one.before, -1.0);
  }
  for (const auto& fixed : arm.point_masses) {
    const Eigen::VectorXd row = deflection_row(fixed.position_m);
    add_product(mass, fixed.mass_kg, row, row);
  }
  Eigen::Index own = size_ - static_cast<Eigen::Index>(arm.attached.size());
  for (const auto& attached : arm.attached) {
    const Eigen::VectorXd beside =
        Eigen::VectorXd::Unit(size_, own) - deflection_row(attached.position_m);
    add_product(stiffness, attached.stiffness_N_per_m, beside, beside);
    add_product(damping, attached.damping_N_s_per_m, beside, beside);
    if (arm.gravity_m_per_s2 != 0.0) {
      const Eigen::VectorXd turn = rotation_row(attached.position_m);
      add_product(stiffness, weight_N(attached), beside, turn);
      add_product(stiffness, weight_N(attached), turn, beside);
    }
    add_one(mass, attached.mass_kg, own);
    rigid_(own++) = arm.hub_radius_m + attached.position_m;
  }
  mass_ = assembled(size_, mass);
  stiffness_ = assembled(size_, stiffness);
  damping_ = assembled(size_, damping);
  for (const arm::Sensor& sensor : sensors) readings_.push_back(make_reading(sensor));
}

void ElementModel::lay_out(int elements, std::span<const arm::Sensor> sensors) {
  const double length = arm_.length_m;
  // Places where the mesh has to have a node, with the springs there.
  struct Node {
    double compliance_rad_per_N_m = 0.0;
    double damping_N_m_s_per_rad = 0.0;
  };
  std::map<double, Node> places = {{0.0, {}}, {length, {}}};
  const auto place = [&](double position_m) -> Node& {
    for (auto& [at, node] : places) {
      if (std::abs(at - position_m) <= kSamePlace * length) return node;
    }
    if (position_m < 0.0 || position_m > length) throw std::runtime_error("not on the beam");
    return places[position_m];
  };
  for (const auto& spring : arm_.springs) {
    Node& node = place(spring.position_m);
    node.compliance_rad_per_N_m += 1.0 / spring.stiffness_N_m_per_rad;
    node.damping_N_m_s_per_rad += spring.damping_N_m_s_per_rad;
  }
  for (const auto& fixed : arm_.point_masses) place(fixed.position_m);
  for (const auto& attached : arm_.attached) place(attached.position_m);
  for (const arm::Sensor& sensor : sensors) {
    if (sensor.kind == arm::SensorKind::strain) place(sensor.position_m);
  }
  const bool shears = arm_.shear_coefficient.has_value();
  if (arm_.gear) {
    load_ = size_++;
    stretches_.push_back(
        {load_, kHub, arm_.gear->stiffness_N_m_per_rad, arm_.gear->damping_N_m_s_per_rad});
  }
  const std::pair<Eigen::Index, double> root{load_, arm_.hub_radius_m};
  std::pair<Eigen::Index, double> deflection = root;
  Eigen::Index rotation = load_;
  std::vector<std::pair<Eigen::Index, double>> rigid = {{kHub, 1.0}, {load_, 1.0}};
  const auto further = [&](double rigid_value) {
    rigid.emplace_back(size_, rigid_value);
    return size_++;
  };
  for (auto at = places.begin(); std::next(at) != places.end(); ++at) {
    const double from = at->first;
    const double span = std::next(at)->first - from;
    const int pieces = static_cast<int>(std::ceil(elements * span / length - kSamePlace));
    if (const Node& node = at->second; node.compliance_rad_per_N_m > 0.0) {
      const Eigen::Index before = rotation;
      rotation = further(1.0);
      stretches_.push_back(
          {rotation, before, 1.0 / node.compliance_rad_per_N_m, node.damping_N_m_s_per_rad});
    }
    for (int i = 0; i < pieces; ++i) {
      Element element{from + span * i / pieces, span / pieces, {deflection, {rotation, 1.0}}};
      const double reach = arm_.hub_radius_m + element.from_m;
      if (shears) {
        element.places.emplace_back(further(reach + element.length_m / 3.0), 1.0);
        element.places.emplace_back(further(reach + element.length_m * 2.0 / 3.0), 1.0);
        element.places.emplace_back(further(1.0), 1.0);
      }
      deflection = {further(reach + element.length_m), 1.0};
      rotation = further(1.0);
      element.places.push_back(deflection);
      element.places.emplace_back(rotation, 1.0);
      elements_.push_back(element);
    }
  }
  tip_deflection_ = deflection.first;
  tip_rotation_ = rotation;
  size_ += static_cast<Eigen::Index>(arm_.attached.size());
  rigid_ = Eigen::VectorXd::Zero(size_);
  for (const auto& [at, value] : rigid) rigid_(at) = value;
}

double ElementModel::tension_N(double position_m) const {
  const double beyond_m = arm_.length_m - position_m;
  // The mean thickness of what is beyond is that at its middle.
  const double mean = arm_.thickness_ratio(position_m + 0.5 * beyond_m);
  double beyond_kg = arm_.payload_kg + arm_.linear_density_kg_per_m * mean * beyond_m;
  const auto add_beyond = [&](const auto& masses) {
    for (const auto& mass : masses) {
      if (mass.position_m >= position_m) beyond_kg += mass.mass_kg;
    }
  };
  add_beyond(arm_.point_masses);
  add_beyond(arm_.attached);
  return arm_.gravity_m_per_s2 * beyond_kg;
}

double ElementModel::rigidity_N_m2(double thickness_ratio) const {
  return thickness_ratio * thickness_ratio * thickness_ratio * arm_.flexural_rigidity_N_m2;
}

double ElementModel::weight_N(const TrueArm::AttachedMass& mass) const {
  return arm_.gravity_m_per_s2 * mass.mass_kg;
}

double ElementModel::shear_rigidity_N() const {
  return arm_.shear_coefficient.value() * arm_.shear_modulus_Pa.value() * arm_.width_m.value() *
         arm_.thickness_m.value();
}

double ElementModel::hub_stiffness_N_m() const {
  return tension_N(0.0) * arm_.hub_radius_m;
}

double ElementModel::tip_stiffness_N_m() const {
  return arm_.gravity_m_per_s2 * arm_.payload_kg * arm_.payload_offset_m;
}

ElementModel::Square ElementModel::square_of(const Element& element) const {
  const bool shears = arm_.shear_coefficient.has_value();
  const Eigen::Index n = element_size(shears);
  Square square{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n),
                Eigen::MatrixXd::Zero(n, n)};
  for (const GaussPlace& gauss : kGauss) {
    const ElementShapes at = element_shapes(shears, element.length_m, gauss.part);
    const double ratio = arm_.thickness_ratio(element.from_m + gauss.part * element.length_m);
    const double m = ratio * arm_.linear_density_kg_per_m;
    const double dx = gauss.weight * element.length_m;
    const Eigen::MatrixXd bending =
        dx * rigidity_N_m2(ratio) * at.curvature * at.curvature.transpose();
    const Eigen::MatrixXd motion = dx * at.deflection * at.deflection.transpose();
    square.mass += m * motion;
    square.stiffness += bending + dx * tension_N(element.from_m + gauss.part * element.length_m) *
                                      at.slope * at.slope.transpose();
    square.damping += arm_.kelvin_voigt_s * bending + arm_.air_damping_N_s_per_m2 * motion;
    if (!shears) continue;
    const double rotary_kg_m = m * std::pow(arm_.thickness_m.value(), 2) / 12.0;
    const Eigen::VectorXd strain = at.slope - at.rotation;
    square.mass += dx * rotary_kg_m * at.rotation * at.rotation.transpose();
    square.stiffness += dx * shear_rigidity_N() * strain * strain.transpose();
  }
  return square;
}

bool ElementModel::turns_freely() const {
  return arm_.hub_spring_N_m_per_rad == 0.0 && arm_.gravity_m_per_s2 == 0.0;
}

double ElementModel::total_inertia_kg_m2() const {
  return rigid_.dot(mass_ * rigid_);
}

double ElementModel::twice_potential(const Eigen::VectorXd& u) const {
  const bool shears = arm_.shear_coefficient.has_value();
  double sum = arm_.hub_spring_N_m_per_rad * u(kHub) * u(kHub) +
               hub_stiffness_N_m() * u(load_) * u(load_) +
               tip_stiffness_N_m() * u(tip_rotation_) * u(tip_rotation_);
  for (const Stretch& one : stretches_) {
    sum += one.stiffness_N_m_per_rad * std::pow(u(one.beyond) - u(one.before), 2);
  }
  Eigen::Index own = size_ - static_cast<Eigen::Index>(arm_.attached.size());
  for (const auto& attached : arm_.attached) {
    const double beside = u(own++) - deflection_row(attached.position_m).dot(u);
    sum += beside * (attached.stiffness_N_per_m * beside +
                     2.0 * weight_N(attached) * rotation_row(attached.position_m).dot(u));
  }
  Eigen::VectorXd local(element_size(shears));
  for (const Element& element : elements_) {
    for (std::size_t i = 0; i < element.places.size(); ++i) {
      local(static_cast<Eigen::Index>(i)) = element.places[i].second * u(element.places[i].first);
    }
    for (const GaussPlace& gauss : kGauss) {
      const ElementShapes at = element_shapes(shears, element.length_m, gauss.part);
      const double slope = at.slope.dot(local);
      const double ratio = arm_.thickness_ratio(element.from_m + gauss.part * element.length_m);
      double density = rigidity_N_m2(ratio) * std::pow(at.curvature.dot(local), 2) +
                       tension_N(element.from_m + gauss.part * element.length_m) * slope * slope;
      if (shears) density += shear_rigidity_N() * std::pow(slope - at.rotation.dot(local), 2);
      sum += gauss.weight * element.length_m * density;
    }
  }
  return sum;
}

Eigen::VectorXd ElementModel::spread(const Element& element, const Eigen::VectorXd& local) const {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(size_);
  for (std::size_t i = 0; i < element.places.size(); ++i) {
    const auto& [at, factor] = element.places[i];
    row(at) += factor * local(static_cast<Eigen::Index>(i));
  }
  return row;
}

const ElementModel::Element& ElementModel::element_at(double position_m) const {
  const double beyond_m = position_m + kSamePlace * arm_.length_m;
  return *std::prev(std::ranges::upper_bound(elements_, beyond_m, {}, &Element::from_m));
}

ElementShapes ElementModel::shapes_at(const Element& element, double position_m) const {
  const double part = std::clamp((position_m - element.from_m) / element.length_m, 0.0, 1.0);
  return element_shapes(arm_.shear_coefficient.has_value(), element.length_m, part);
}

Eigen::VectorXd ElementModel::deflection_row(double position_m) const {
  const Element& element = element_at(position_m);
  return spread(element, shapes_at(element, position_m).deflection);
}

Eigen::VectorXd ElementModel::rotation_row(double position_m) const {
  const Element& element = element_at(position_m);
  return spread(element, shapes_at(element, position_m).rotation);
}

ReadingRow ElementModel::make_reading(const arm::Sensor& sensor) const {
  if (sensor.kind == arm::SensorKind::strain) return strain_reading(sensor.position_m);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(size_);
  ReadingRow row{zero, zero, zero};
  if (sensor.kind == arm::SensorKind::hub_angle || sensor.kind == arm::SensorKind::hub_velocity) {
    row.stiffness(kHub) = 1.0;
    return row;
  }
  row.stiffness(tip_deflection_) = 1.0;
  if (sensor.kind == arm::SensorKind::tip_deflection) {
    row.stiffness(load_) = -(arm_.hub_radius_m + arm_.length_m);
  }
  return row;
}

ReadingRow ElementModel::strain_reading(double position_m) const {
  // The work of the inner moment on a rotation of the node alone: outwards of it the element's
  // forces are -EI psi', and EI psi' inwards, of which the tip has none beyond.
  const auto near = [&](const Element& one) {
    return std::abs(one.from_m - position_m) <= kSamePlace * arm_.length_m;
  };
  const auto found = std::ranges::find_if(elements_, near);
  const bool at_tip = found == elements_.end();
  const Element& element = at_tip ? elements_.back() : *found;
  const Square square = square_of(element);
  const Eigen::Index node = at_tip ? square.mass.rows() - 1 : 1;
  const double sign = at_tip ? 1.0 : -1.0;
  const double ratio = arm_.thickness_ratio(position_m);
  const double scale = sign * 0.5 * ratio * arm_.thickness_m.value() / rigidity_N_m2(ratio);
  return {scale * spread(element, square.stiffness.row(node).transpose()),
          scale * spread(element, square.damping.row(node).transpose()),
          scale * spread(element, square.mass.row(node).transpose()), arm_.kelvin_voigt_s};
}

}  // namespace flexarm::trials
