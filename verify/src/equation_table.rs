//! The table of equations: for each numbered equation its label, the items that implement it, the checks and golden tables
//! about it. `docs/equations.md` is this table; a test keeps it so, and keeps every public function in it.

use std::fmt::Write;

use crate::checks;

/// One numbered equation of the paper.
#[derive(Debug, Clone, Copy)]
pub struct Equation {
    /// Its number, counting the paper's numbered equations in order.
    pub number: u8,
    /// Its LaTeX label, empty where it has none.
    pub label: &'static str,
    /// What it says.
    pub subject: &'static str,
    /// Paths in the crate `twofold` of what implements it; none where it is no function.
    pub items: &'static [&'static str],
    /// Golden tables with numbers of it.
    pub golden: &'static [&'static str],
}

const fn row(
    number: u8,
    label: &'static str,
    subject: &'static str,
    items: &'static [&'static str],
    golden: &'static [&'static str],
) -> Equation {
    Equation { number, label, subject, items, golden }
}

/// The equations covered so far, in the paper's order. Numbers and labels are those of its LaTeX source, `Introduction` to appendix, where each numbered
/// line counts; the first four are in the introduction.
pub const EQUATIONS: &[Equation] = &[
    row(
        1,
        "action",
        "action of the minimal gravitational SME: not a function; of its term k R the part that gives Eq. (3) is checked",
        &[],
        &[],
    ),
    row(
        2,
        "pecorrect",
        "anisotropic potential energy of two point masses",
        &["dynamics::point_masses::anisotropic_potential_of_masses"],
        &[],
    ),
    row(
        3,
        "",
        "coefficients s from the vacuum value of the field of the action",
        &["curvature_coupling::coefficients_from_vacuum_value"],
        &[],
    ),
    row(
        4,
        "ppndeu",
        "the same potential energy in the PPN formalism",
        &["dynamics::point_masses::preferred_frame_potential_of_masses"],
        &[],
    ),
    row(
        5,
        "replace",
        "PPN replacement s^ij -> -alpha_2 w^i w^j",
        &["lorentz_violation::coefficients_from_preferred_frame", "lorentz_violation::preferred_frame_parameter"],
        &[],
    ),
    row(
        6,
        "pecorrect1",
        "anisotropic self-energy of any body",
        &["dynamics::potential::anisotropic_potential_of_body"],
        &[],
    ),
    row(7, "", "s^ij in the body frame", &["euler_angles::tensor_in_body_frame"], &[]),
    row(
        8,
        "rmat",
        "rotation matrix R^{iI} = e_i . e_I",
        &["euler_angles::body_from_inertial", "dynamics::BodyState"],
        &[],
    ),
    row(
        9,
        "trans",
        "body axes in Euler angles",
        &["euler_angles::body_from_inertial", "euler_angles::symmetry_axis", "euler_angles::angles_from_rotation"],
        &["figure_euler_angles"],
    ),
    row(
        10,
        "spheroid",
        "surface of a spheroid",
        &["star::spheroid_shape::SpheroidShape", "star::uniform_spheroid::UniformSpheroid"],
        &[],
    ),
    row(
        11,
        "pecorrect2",
        "delta U = C s^zz",
        &["dynamics::potential::anisotropic_potential", "dynamics::potential::anisotropic_potential_of_axis"],
        &[],
    ),
    row(
        12,
        "",
        "constant C as an integral",
        &[
            "star::axisymmetric::axisymmetric_integrals",
            "star::axisymmetric::AxisymmetricIntegrals",
            "star::uniform_spheroid::UniformSpheroid",
        ],
        &[],
    ),
    row(13, "ppndeu1", "Nordtvedt's form of the self-energy", &["dynamics::potential::nordtvedt_potential"], &[]),
    row(14, "", "tensor virial relation", &["star::maclaurin::MaclaurinSpheroid"], &[]),
    row(
        15,
        "",
        "kinetic tensor, pressure integral, potential-energy tensor",
        &["star::maclaurin::MaclaurinSpheroid", "star::AxisymmetricTensor"],
        &[],
    ),
    row(16, "newp", "Newtonian potential", &["star::axisymmetric::axisymmetric_integrals"], &[]),
    row(
        17,
        "",
        "U^ij as a double integral",
        &[
            "star::uniform_spheroid::UniformSpheroid::potential_energy_tensor",
            "star::ellipsoid::UniformEllipsoid::potential_energy_tensor",
            "star::axisymmetric::axisymmetric_integrals",
        ],
        &[],
    ),
    row(18, "", "K^zz = 0, T_rot = (K^xx + K^yy)/2", &["star::maclaurin::MaclaurinSpheroid"], &[]),
    row(
        19,
        "obl",
        "oblateness",
        &["dynamics::RigidSpheroid::oblateness", "star::spheroid_shape::SpheroidShape::oblateness"],
        &[],
    ),
    row(
        20,
        "epf",
        "centrifugal deformation",
        &[
            "star::deformation::centrifugal_oblateness",
            "star::deformation::centrifugal_oblateness_scaled",
            "star::deformation::centrifugal_coefficient",
        ],
        &["star_estimates"],
    ),
    row(
        21,
        "anisopot",
        "self-energy in Euler angles",
        &["dynamics::potential::anisotropic_potential_in_angles", "dynamics::potential::potential_gradient_in_angles"],
        &[],
    ),
    row(
        22,
        "angvel1",
        "angular velocity in the body frame",
        &["euler_angles::body_rates", "euler_angles::euler_rates", "dynamics::equations_of_motion::angular_velocity"],
        &[],
    ),
    row(
        23,
        "",
        "rotational kinetic energy",
        &[
            "dynamics::kinetic_energy::kinetic_energy",
            "dynamics::kinetic_energy::kinetic_energy_of_body",
            "dynamics::lagrangian::lagrangian",
        ],
        &[],
    ),
    row(
        24,
        "firstint",
        "first integrals E and Omega^z; beyond the paper, K",
        &[
            "dynamics::first_integrals::energy_in_angles",
            "dynamics::first_integrals::spin_in_angles",
            "dynamics::first_integrals::symmetric_adjugate",
            "dynamics::first_integrals::first_integrals",
        ],
        &[],
    ),
    row(
        25,
        "eleq",
        "equations of motion",
        &[
            "dynamics::euler_angle_equations::euler_angle_residuals",
            "dynamics::euler_angle_equations::euler_angle_accelerations",
            "dynamics::equations_of_motion::reduced_rates",
            "dynamics::equations_of_motion::body_state_rates",
            "propagation::propagate",
            "propagation::propagate_axis",
            "propagation::TaylorMotion",
            "propagation::splitting::propagate_by_splitting",
            "propagation::splitting::propagate_by_best_splitting",
            "propagation::splitting::propagate_orientation_by_splitting",
            "propagation::splitting::propagate_orientation_by_best_splitting",
            "propagation::splitting::Splitting",
            "propagation::axis_states_at",
            "propagation::axis_states_of_many",
            "propagation::splitting::SplittingMotion::scheme",
            "propagation::splitting::SplittingMotion::step",
            "propagation::splitting::SplittingMotion::step_count",
            "propagation::splitting::Scheme",
            "propagation::splitting::splitting_forecast",
            "propagation::states_at",
            "propagation::states_of_many",
            "dynamics::AxisState",
            "dynamics::Problem",
            "propagation::ContinuousAngles",
            "solutions::symmetric::SymmetricSolution",
        ],
        &["figure_motion_tp_1", "figure_motion_tp_2", "figure_motion_sp_1", "figure_motion_sp_2"],
    ),
    row(26, "sol1", "steady precession for symmetric s", &["solutions::steady::steady_precession_rate"], &[]),
    row(27, "ansatz", "perturbation ansatz", &["solutions::perturbation::Perturbation::at"], &[]),
    row(
        28,
        "",
        "zeroth-order rate",
        &["solutions::perturbation::Perturbation", "dynamics::RigidSpheroid::free_precession_constant"],
        &["perturbation_constants"],
    ),
    row(
        29,
        "eleq1",
        "first-order equations, as printed and in full",
        &[
            "solutions::perturbation::linearised::printed_residuals",
            "solutions::perturbation::linearised::full_residuals",
            "solutions::perturbation::Precession",
        ],
        &[],
    ),
    row(
        30,
        "sol2",
        "first-order rates",
        &["solutions::perturbation::Perturbation::first_order_rates", "solutions::perturbation::Form"],
        &[],
    ),
    row(
        31,
        "consdef",
        "a^(1), C~, eta_alpha, eta_beta",
        &["solutions::perturbation::Perturbation::new", "lorentz_violation::PrincipalCoefficients"],
        &["perturbation_constants"],
    ),
    row(
        32,
        "precangvel",
        "precession rate a",
        &["solutions::perturbation::Perturbation::new"],
        &["perturbation_constants"],
    ),
    row(
        33,
        "sol3",
        "first-order angles",
        &["solutions::perturbation::Perturbation::first_order"],
        &["twofold_regimes", "single_regimes", "figure_perturbation_regimes", "figure_method_regimes"],
    ),
    row(
        34,
        "integraltoinitial",
        "initial values from the constants, and back",
        &["solutions::perturbation::initial_values", "solutions::perturbation::constants_from_initial_values"],
        &["caption_initial_values"],
    ),
    row(
        35,
        "unitt",
        "unit of time t_c",
        &["dynamics::RigidSpheroid::time_unit", "dynamics::RigidSpheroid::in_units_of_tc", "units::time_unit"],
        &[],
    ),
    row(
        36,
        "",
        "permutation of the axes",
        &["lorentz_violation::PrincipalCoefficients::permuted", "euler_angles::permuted_from_inertial"],
        &["figure_euler_angles_yzx", "figure_momentum_sphere"],
    ),
    row(
        37,
        "",
        "angle between the spin axis and a direction",
        &["observables::spin_axis::cos_lambda_in_angles", "observables::spin_axis::cos_lambda_rate"],
        &[],
    ),
    row(38, "", "its change", &["observables::spin_axis::cos_lambda_change"], &[]),
    row(39, "", "changes of alpha and beta in single precession", &["observables::spin_axis::changes_from_start"], &[]),
    row(
        40,
        "est",
        "estimate of the bound",
        &["observables::bound::SpinAxisDrift", "observables::bound::eta_from_inclination"],
        &[],
    ),
    row(
        41,
        "est1",
        "estimate of the bound with eta, and eta itself; the same as a bound on alpha_2",
        &[
            "observables::bound::SpinAxisDrift::combination_bound",
            "observables::bound::preferred_frame_bound",
            "observables::eta::secular_axis_rate",
            "observables::eta::squared_speed",
            "observables::eta::mean_squared_speed",
            "observables::eta::squared_speed_along_motion",
            "observables::eta::root_mean_square_eta",
            "observables::eta::single_precession_start",
            "observables::eta_distribution::EtaDistribution",
            "observables::eta_distribution::root_mean_square_along_motion",
        ],
        &["pulsar_bounds", "eta", "figure_bound_factor"],
    ),
    row(
        42,
        "dela",
        "change of lambda from the change of the pulse width",
        &[
            "observables::bound::lambda_change",
            "observables::bound::lambda_change_terms",
            "observables::bound::zeta_change_terms",
            "observables::bound::cos_opening_angle",
        ],
        &["pulsar_bounds"],
    ),
    row(
        43,
        "",
        "estimate of I^zz / C",
        &["star::estimates::inertia_over_c_estimate", "observables::bound::fluid_inertia_over_c"],
        &["star_estimates"],
    ),
    row(
        44,
        "ineq",
        "line of sight inside the beam",
        &[
            "observables::pulsar::Beam::margin",
            "observables::pulsar::Beam::margin_rates",
            "observables::pulsar::train::pulse_train",
            "observables::pulsar::train::propagated_pulse_train",
            "propagation::Turning",
            "observables::pulsar::Pulse",
            "observables::pulsar::PulseTrain",
            "observables::pulsar::Stamped",
            "observables::pulsar::rate_bounds::RateBounds",
            "observables::pulsar::rate_bounds::rate_bounds",
            "observables::pulsar::event_time::event_time",
        ],
        &["figure_pulse_series"],
    ),
    row(
        45,
        "",
        "magnetic axis in the body",
        &[
            "observables::pulsar::Beam::new",
            "observables::pulsar::Beam::opposite",
            "observables::pulsar::Beam::direction",
        ],
        &["figure_beam_cone"],
    ),
    row(46, "", "direction of the observer", &["observables::Observer"], &[]),
    row(
        47,
        "pulsemn",
        "m.n in Euler angles",
        &["observables::pulsar::beam::axis_along_line_of_sight"],
        &["spectral_lines", "figure_beam_alignment", "figure_beam_alignment_spectra"],
    ),
    row(
        48,
        "angfreqfre",
        "rates of free precession",
        &["solutions::free::free_precession_rates", "solutions::free::free_rotation", "solutions::free::rotated_by"],
        &["perturbation_constants"],
    ),
    row(
        49,
        "tranang",
        "direction of the magnetic axis",
        &[
            "observables::pulsar::direction::cosine_of_colatitude",
            "observables::pulsar::direction::magnetic_axis_direction",
        ],
        &[],
    ),
    row(
        50,
        "",
        "azimuth relative to the line of nodes",
        &[
            "observables::pulsar::direction::azimuth_offset_point",
            "observables::pulsar::direction::magnetic_axis_direction",
        ],
        &[],
    ),
    row(
        51,
        "pulsep",
        "pulsar period",
        &[
            "observables::pulsar::period::azimuth_rate",
            "observables::pulsar::period::instantaneous_period",
            "observables::pulsar::period::approximate_period",
            "observables::pulsar::PulseTrain::periods",
        ],
        &[],
    ),
    row(
        52,
        "",
        "rate of the azimuth relative to the line of nodes",
        &["observables::pulsar::period::azimuth_offset_rate"],
        &[],
    ),
    row(
        53,
        "",
        "pulse width",
        &[
            "observables::pulsar::width::edge_azimuths",
            "observables::pulsar::width::PulseWidth",
            "observables::pulsar::PulseTrain::durations",
        ],
        &[],
    ),
    row(
        54,
        "mninertial",
        "m.n in colatitudes and azimuths",
        &["observables::pulsar::direction::axis_along_line_of_sight_in_azimuth"],
        &[],
    ),
    row(55, "", "azimuths of the edges", &["observables::pulsar::width::edge_azimuths"], &[]),
    row(
        56,
        "pulsewid",
        "pulse width at constant colatitude",
        &["observables::pulsar::width::pulse_width", "observables::pulsar::width::cosine_of_half_width"],
        &[],
    ),
    row(57, "tpconstant", "shifted rates", &["solutions::perturbation::shifted_rates"], &["perturbation_constants"]),
    row(58, "", "estimate of t_c", &["star::estimates::time_unit_estimate"], &["star_estimates"]),
    row(59, "", "quadrupole formula", &["observables::gravitational_wave::metric_perturbation"], &[]),
    row(60, "", "I^{IJ} in the inertial frame", &["dynamics::wave_source::tensor_in_inertial_frame"], &[]),
    row(61, "", "infinitesimal rotation of the body axes", &["dynamics::wave_source::rotation_rate"], &[]),
    row(62, "1stdrmat", "rate of the rotation matrix", &["dynamics::wave_source::rotation_rate"], &[]),
    row(63, "", "equation of motion with torque", &["dynamics::angular_acceleration::angular_acceleration"], &[]),
    row(
        64,
        "",
        "ddot I^{IJ} = R R A",
        &["dynamics::wave_source::tensor_in_inertial_frame", "dynamics::wave_source::spheroid_inertia_acceleration"],
        &[],
    ),
    row(65, "gwa", "body-frame tensor A^ij", &["dynamics::wave_source::wave_tensor"], &[]),
    row(
        66,
        "",
        "torque",
        &[
            "dynamics::torque::torque_from_gradient",
            "dynamics::torque::torque_on_body",
            "dynamics::equations_of_motion::torque_on_axis",
        ],
        &[],
    ),
    row(67, "", "differences of the moments of inertia", &["dynamics::PrincipalInertia::differences"], &[]),
    row(68, "gwwf", "ddot I^{IJ} of free precession", &["dynamics::wave_source::free_inertia_acceleration"], &[]),
    row(69, "", "polarization tensors", &["observables::gravitational_wave::polarization_tensors"], &[]),
    row(70, "thphinertial", "basis normal to the line of sight", &["observables::Observer::at"], &[]),
    row(
        71,
        "hpluscross",
        "h_+ and h_x",
        &[
            "observables::gravitational_wave::polarizations",
            "observables::gravitational_wave::wave_of_state",
            "observables::gravitational_wave::Polarizations",
            "observables::gravitational_wave::strain_unit",
        ],
        &["spectral_lines", "figure_waves", "figure_wave_spectra"],
    ),
    row(72, "ecc", "eccentricity", &["star::spheroid_shape::SpheroidShape"], &[]),
    row(
        73,
        "",
        "interior potential of a uniform ellipsoid",
        &["star::ellipsoid::UniformEllipsoid", "star::potential_coefficients::PotentialCoefficients"],
        &[],
    ),
    row(
        74,
        "",
        "A_0, A_1, A_2, A_3",
        &["star::potential_coefficients::potential_coefficients", "star::ellipsoid::UniformEllipsoid::coefficients"],
        &["appendix_expansions"],
    ),
    row(
        75,
        "",
        "C of a uniform spheroid",
        &["star::uniform_spheroid::UniformSpheroid::c", "star::potential_coefficients::reduced_difference"],
        &["appendix_expansions"],
    ),
    row(76, "", "hydrostatic equilibrium", &["star::maclaurin::MaclaurinSpheroid::pressure"], &[]),
    row(77, "", "rotation of a Maclaurin spheroid", &["star::maclaurin::MaclaurinSpheroid::new"], &[]),
    row(78, "estc", "T_rot = 2 C", &["star::maclaurin::MaclaurinSpheroid::new"], &[]),
    row(79, "", "oblateness from the eccentricity", &["star::spheroid_shape::SpheroidShape::oblateness"], &[]),
];

/// What serves the equations without having a number of its own in the paper.
pub const AUXILIARY: &[(&str, &[&str])] = &[
    ("number types", &["scalar::constant_vector", "scalar::length", "scalar::real_part"]),
    (
        "principal axes of s^IJ",
        &[
            "lorentz_violation::principal_frame",
            "lorentz_violation::principal_frame_with_derivatives",
            "lorentz_violation::principal_frame_along",
            "lorentz_violation::SymmetryOfTensor",
        ],
    ),
    (
        "plans: what is computed for the outputs asked, by which method",
        &[
            "plan::Plan",
            "plan::Method",
            "plan::Output",
            "plan::State",
            "plan::Request",
            "plan::Prediction",
            "plan::Promise",
            "plan::Cost",
            "plan::Counted",
            "plan::Work",
            "plan::PlannedMotion",
            "plan::gradient",
            "plan::gradient_in_parts",
            "plan::Parameter",
            "plan::Start",
            "propagation::taylor_forecast",
        ],
    ),
    (
        "motions in closed form",
        &["propagation::SymmetricMotion", "propagation::UniformMotion", "propagation::largest_torque"],
    ),
    ("Euler rates of n and L", &["dynamics::equations_of_motion::euler_rates_of_axis"]),
    (
        "Carlson's symmetric integrals",
        &[
            "elliptic::carlson::rf",
            "elliptic::carlson::rc",
            "elliptic::carlson::rd",
            "elliptic::carlson::rj",
            "elliptic::carlson::rf_of_roots",
            "elliptic::carlson::rj_of_roots",
        ],
    ),
    (
        "Jacobi's functions",
        &[
            "elliptic::jacobi::ArithmeticGeometricMean",
            "elliptic::jacobi::JacobiFunctions",
            "elliptic::jacobi::complete_integral",
            "elliptic::jacobi::jacobi",
        ],
    ),
    (
        "spectra and lists of lines",
        &[
            "observables::spectrum::amplitude_spectrum",
            "observables::spectrum::AmplitudeSpectrum",
            "observables::spectrum::spectral_lines",
            "observables::spectrum::LineList",
            "observables::spectrum::SpectralLine",
            "observables::spectrum::Series",
            "observables::spectrum::Window",
            "observables::spectrum::FrequencyBasis",
            "observables::spectrum::Generator",
            "observables::spectrum::Combination",
            "observables::spectrum::Identification",
        ],
    ),
    (
        "fundamental frequencies of a motion",
        &[
            "observables::fundamental_frequencies::fundamental_frequencies",
            "observables::fundamental_frequencies::FundamentalFrequencies",
            "observables::fundamental_frequencies::mean_rates_about",
            "observables::fundamental_frequencies::mean_rate",
            "observables::fundamental_frequencies::MeanRate",
        ],
    ),
    (
        "the averaged motion in closed form: mean Hamiltonian, generator, top, theta functions",
        &[
            "solutions::averaged::mean_potential",
            "solutions::averaged::mean_angular_velocity",
            "solutions::averaged::generator",
            "solutions::averaged::generator_slopes",
            "solutions::averaged::AveragingOrder",
            "solutions::averaged::AveragedSolution",
            "solutions::averaged::AveragedRates",
            "solutions::averaged::AveragedPhases",
            "solutions::averaged::AveragedTurns",
            "solutions::averaged::Turns",
            "propagation::AveragedMotion",
            "solutions::averaged::Top",
            "solutions::averaged::TopPhases",
            "solutions::averaged::TopShape",
            "elliptic::theta::Nome",
            "elliptic::theta::ThetaSeries",
            "elliptic::theta::AtPhase",
        ],
    ),
    (
        "invariant tori: states with given E, Omega^z and K, exact frequencies, the separatrix",
        &[
            "solutions::torus::states_with_integrals",
            "solutions::torus::TorusStates",
            "solutions::torus::torus_frequencies",
            "solutions::torus::TorusFrequencies",
            "solutions::torus::separatrix_motion",
            "solutions::averaged::middle_axis_growth",
            "solutions::averaged::period_near_separatrix",
        ],
    ),
    (
        "slow precession of the averaged angular momentum",
        &[
            "solutions::averaged::slow_precession::slow_precession",
            "solutions::averaged::slow_precession::SlowPrecession",
        ],
    ),
    (
        "times of arrival, pulse numbers, residuals against a constant period",
        &[
            "observables::pulsar::arrival::arrivals",
            "observables::pulsar::Arrival",
            "observables::pulsar::ConstantPeriod",
        ],
    ),
    (
        "pulses over decades: epochs, numbers without a break, fits of frequency",
        &[
            "epoch::Epoch",
            "observables::pulsar::PulsarClock",
            "observables::pulsar::ClockPulse",
            "observables::pulsar::NearState",
            "observables::pulsar::SpinFit",
        ],
    ),
    ("harmonics of the wave over a turn", &["observables::wave_harmonics::WaveHarmonics"]),
    (
        "position angle of the polarization, rotating-vector model",
        &[
            "observables::pulsar::position_angle::sky_from_inertial",
            "observables::pulsar::position_angle::position_angle",
            "observables::pulsar::position_angle::position_angle_rate",
            "observables::pulsar::position_angle::rotating_vector_point",
            "observables::pulsar::position_angle::rotating_vector_position_angle",
            "observables::pulsar::position_angle::rotating_vector_gradient",
        ],
    ),
    ("errors at public boundaries", &["error::Error"]),
    ("densities for the quadrature", &["star::axisymmetric::AxisymmetricBody"]),
];

/// The table as the Markdown page `docs/equations.md`.
pub fn markdown() -> String {
    let all = checks::all();
    let mut page = String::from(
        "# Equations\n\n\
         Generated by `cargo run --release -- equations > docs/equations.md`; a test keeps it true.\n\n\
         Numbers count the paper's numbered equations in order, as its LaTeX source sets them, and labels are those of that source. Items are paths in the crate `twofold`; checks run by\n\
         `cargo run --release -- verify --filter ID`; golden tables are files of `golden/`.\n\n\
         | Eq. | label | subject | items | checks | golden |\n|---|---|---|---|---|---|\n",
    );
    let code =
        |names: &mut dyn Iterator<Item = &str>| names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    for equation in EQUATIONS {
        let about = all.iter().filter(|check| check.equations.contains(&equation.number));
        let label = if equation.label.is_empty() { String::new() } else { format!("`{}`", equation.label) };
        writeln!(
            page,
            "| ({}) | {} | {} | {} | {} | {} |",
            equation.number,
            label,
            equation.subject,
            code(&mut equation.items.iter().copied()),
            code(&mut about.map(|check| check.id)),
            code(&mut equation.golden.iter().copied()),
        )
        .expect("writing to a string succeeds");
    }
    page.push_str("\n## Beside the numbered equations\n\n| subject | items |\n|---|---|\n");
    for (subject, items) in AUXILIARY {
        writeln!(page, "| {subject} | {} |", code(&mut items.iter().copied())).expect("writing to a string succeeds");
    }
    page
}
