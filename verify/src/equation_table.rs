//! The table of equations: for each numbered equation its label, the functions that implement it and the golden tables with its
//! numbers. `docs/equations.md` adds the checks; a test keeps it up to date.

use std::fmt::Write;

use crate::checks;

/// One numbered equation of the paper.
#[derive(Debug, Clone, Copy)]
pub struct Equation {
    /// Its number: the paper's numbered lines in the order of its LaTeX source, `Introduction` to appendix.
    pub number: u8,
    /// Its LaTeX label, empty where it has none.
    pub label: &'static str,
    /// Its content.
    pub subject: &'static str,
    /// Paths in the crate `twofold` of its implementations; empty if it is not a function.
    pub items: &'static [&'static str],
    /// Golden tables with numbers from it.
    pub golden: &'static [&'static str],
}

/// Rows `number "label" "subject" [functions] [golden tables]`. The functions are links in the documentation, so that rustdoc checks them.
macro_rules! equations {
    ($($number:literal $label:literal $subject:literal [$($item:literal)*] [$($golden:literal)*])*) => {
        /// The equations, in the paper's order.
        ///
        $(#[doc = concat!("- (", $number, ") ", $subject, $(": [`", $item, "`](twofold::", $item, ")"),*)])*
        pub const EQUATIONS: &[Equation] = &[$(Equation {
            number: $number, label: $label, subject: $subject, items: &[$($item),*], golden: &[$($golden),*],
        }),*];
    };
}

equations! {
    1 "action" "action of the minimal gravitational SME: not a function; of its term k R the part that gives Eq. (3) is checked"
        [] []
    2 "pecorrect" "anisotropic potential energy of two point masses"
        ["dynamics::point_masses::anisotropic_potential_of_masses"] []
    3 "" "coefficients s from the vacuum value of the field of the action"
        ["curvature_coupling::coefficients_from_vacuum_value"] []
    4 "ppndeu" "the same potential energy in the PPN formalism"
        ["dynamics::point_masses::preferred_frame_potential_of_masses"] []
    5 "replace" "PPN replacement s^ij -> -alpha_2 w^i w^j"
        ["lorentz_violation::coefficients_from_preferred_frame" "lorentz_violation::preferred_frame_parameter"]
         []
    6 "pecorrect1" "anisotropic self-energy of any body" ["dynamics::potential::anisotropic_potential_of_body"] []
    7 "" "s^ij in the body frame" ["euler_angles::tensor_in_body_frame"] []
    8 "rmat" "rotation matrix R^{iI} = e_i . e_I" ["euler_angles::body_from_inertial" "dynamics::BodyState"] []
    9 "trans" "body axes in Euler angles"
        ["euler_angles::body_from_inertial" "euler_angles::symmetry_axis" "euler_angles::angles_from_rotation"]
         ["figure_euler_angles"]
    10 "spheroid" "surface of a spheroid"
        ["star::spheroid_shape::SpheroidShape" "star::uniform_spheroid::UniformSpheroid"] []
    11 "pecorrect2" "delta U = C s^zz"
        ["dynamics::potential::anisotropic_potential_of_axis"] []
    12 "" "constant C as an integral"
        ["star::axisymmetric::axisymmetric_integrals" "star::axisymmetric::AxisymmetricIntegrals"
         "star::uniform_spheroid::UniformSpheroid"] []
    13 "ppndeu1" "Nordtvedt's form of the self-energy" ["dynamics::potential::nordtvedt_potential"] []
    14 "" "tensor virial relation" ["star::maclaurin::MaclaurinSpheroid"] []
    15 "" "kinetic tensor, pressure integral, potential-energy tensor"
        ["star::maclaurin::MaclaurinSpheroid" "star::AxisymmetricTensor"] []
    16 "newp" "Newtonian potential" ["star::axisymmetric::axisymmetric_integrals"] []
    17 "" "U^ij as a double integral"
        ["star::uniform_spheroid::UniformSpheroid::potential_energy_tensor"
         "star::ellipsoid::UniformEllipsoid::potential_energy_tensor"
         "star::axisymmetric::axisymmetric_integrals"] []
    18 "" "K^zz = 0, T_rot = (K^xx + K^yy)/2" ["star::maclaurin::MaclaurinSpheroid"] []
    19 "obl" "oblateness"
        ["dynamics::RigidSpheroid::oblateness" "star::spheroid_shape::SpheroidShape::oblateness"] []
    20 "epf" "centrifugal deformation"
        ["star::deformation::centrifugal_oblateness" "star::deformation::centrifugal_oblateness_scaled"
         "star::deformation::CENTRIFUGAL_COEFFICIENT"] ["star_estimates"]
    21 "anisopot" "self-energy in Euler angles"
        ["dynamics::potential::anisotropic_potential_in_angles"
         "dynamics::potential::potential_gradient_in_angles"] []
    22 "angvel1" "angular velocity in the body frame"
        ["euler_angles::body_rates" "euler_angles::euler_rates" "dynamics::equations_of_motion::angular_velocity"]
         []
    23 "" "rotational kinetic energy"
        ["dynamics::kinetic_energy::kinetic_energy" "dynamics::kinetic_energy::kinetic_energy_of_body"
         "dynamics::lagrangian::lagrangian"] []
    24 "firstint" "first integrals E and Omega^z; beyond the paper, K"
        ["dynamics::first_integrals::energy_in_angles" "dynamics::first_integrals::spin_in_angles" "dynamics::first_integrals::symmetric_adjugate"
         "dynamics::first_integrals::first_integrals"] []
    25 "eleq" "equations of motion"
        ["dynamics::euler_angle_equations::euler_angle_residuals"
         "dynamics::euler_angle_equations::euler_angle_accelerations"
         "dynamics::equations_of_motion::reduced_rates" "dynamics::equations_of_motion::body_state_rates"
         "dynamics::Problem" "dynamics::Problem::taylor" "dynamics::Problem::taylor_states" "propagation::TaylorMotion"
         "dynamics::Problem::splitting" "dynamics::Problem::splitting_by" "propagation::splitting::Splitting"
         "propagation::splitting::SplittingMotion" "propagation::splitting::Scheme" "propagation::states_of_many"
         "propagation::ContinuousAngles" "solutions::symmetric::SymmetricSolution" "solutions::torus::TorusSolution"] ["figure_motion_tp_1"
         "figure_motion_tp_2" "figure_motion_sp_1" "figure_motion_sp_2"]
    26 "sol1" "steady precession for symmetric s" ["solutions::steady::steady_precession_rate"] []
    27 "ansatz" "perturbation ansatz" ["solutions::perturbation::Perturbation::at"] []
    28 "" "zeroth-order rate"
        ["solutions::perturbation::Perturbation" "dynamics::RigidSpheroid::free_precession_constant"]
         ["perturbation_constants"]
    29 "eleq1" "first-order equations, as printed and in full"
        ["solutions::perturbation::linearised::printed_residuals"
         "solutions::perturbation::linearised::full_residuals" "solutions::perturbation::Precession"] []
    30 "sol2" "first-order rates"
        ["solutions::perturbation::Perturbation::first_order_rates" "solutions::perturbation::Form"] []
    31 "consdef" "a^(1), C~, eta_alpha, eta_beta"
        ["solutions::perturbation::Perturbation::new" "lorentz_violation::PrincipalCoefficients"]
         ["perturbation_constants"]
    32 "precangvel" "precession rate a" ["solutions::perturbation::Perturbation::new"] ["perturbation_constants"]
    33 "sol3" "first-order angles"
        ["solutions::perturbation::Perturbation::first_order"] ["twofold_regimes" "single_regimes"
         "figure_perturbation_regimes" "figure_method_regimes"]
    34 "integraltoinitial" "initial values from the constants, and back"
        ["solutions::perturbation::Perturbation::at" "solutions::perturbation::constants_from_initial_values"]
         ["caption_initial_values"]
    35 "unitt" "unit of time t_c"
        ["dynamics::RigidSpheroid::time_unit" "dynamics::RigidSpheroid::in_units_of_tc" "units::time_unit"] []
    36 "" "permutation of the axes"
        ["lorentz_violation::PrincipalCoefficients::permuted" "euler_angles::permuted_from_inertial"]
         ["figure_euler_angles_yzx" "figure_momentum_sphere"]
    37 "" "angle between the spin axis and a direction"
        ["observables::spin_axis::cos_lambda_in_angles"
         "observables::spin_axis::cos_lambda_rate"] []
    38 "" "its change" ["observables::spin_axis::cos_lambda_change"] []
    39 "" "changes of alpha and beta in single precession" ["observables::spin_axis::changes_from_start"] []
    40 "est" "estimate of the bound" ["observables::bound::SpinAxisDrift" "observables::bound::eta_from_inclination"] []
    41 "est1" "estimate of the bound with eta, and eta itself; the same as a bound on alpha_2"
        ["observables::bound::SpinAxisDrift::combination_bound" "observables::bound::preferred_frame_bound"
         "observables::eta::secular_axis_rate" "observables::eta::squared_speed"
         "observables::eta::mean_squared_speed" "observables::eta::squared_speed_along_motion"
         "observables::eta::root_mean_square_eta" "observables::eta::single_precession_start"
         "observables::eta_distribution::EtaDistribution"
         "observables::eta_distribution::root_mean_square_along_motion"] ["pulsar_bounds" "eta"
         "figure_bound_factor"]
    42 "dela" "change of lambda from the change of the pulse width"
        ["observables::bound::lambda_change" "observables::bound::lambda_change_terms" "observables::bound::zeta_change_terms"
         "observables::bound::cos_opening_angle"] ["pulsar_bounds"]
    43 "" "estimate of I^zz / C"
        ["star::estimates::inertia_over_c_estimate" "observables::bound::fluid_inertia_over_c"]
         ["star_estimates"]
    44 "ineq" "line of sight inside the beam"
        ["observables::pulsar::Beam::margin" "observables::pulsar::Beam::margin_rates"
         "observables::pulsar::train::pulse_train"
         "propagation::SeriesProjection" "propagation::Turning" "observables::pulsar::Pulse"
         "observables::pulsar::PulseTrain" "observables::pulsar::Stamped"
         "observables::pulsar::rate_bounds::RateBounds" "observables::pulsar::rate_bounds::rate_bounds"
         "observables::pulsar::event_time::event_time"] ["figure_pulse_series" "figure_spin_down" "figure_violation_residuals"]
    45 "" "magnetic axis in the body"
        ["observables::pulsar::Beam::new" "observables::pulsar::Beam::opposite"
         "observables::pulsar::Beam::direction"] ["figure_beam_cone"]
    46 "" "direction of the observer" ["observables::Observer"] []
    47 "pulsemn" "m.n in Euler angles"
        ["observables::pulsar::beam::axis_along_line_of_sight"] ["spectral_lines" "figure_beam_alignment"
         "figure_beam_alignment_spectra"]
    48 "angfreqfre" "rates of free precession"
        ["solutions::free::free_precession_rates" "solutions::free::free_rotation"
         "solutions::free::rotated_by"] ["perturbation_constants"]
    49 "tranang" "direction of the magnetic axis"
        ["observables::pulsar::direction::cosine_of_colatitude"
         "observables::pulsar::direction::magnetic_axis_direction"] []
    50 "" "azimuth relative to the line of nodes"
        ["observables::pulsar::direction::azimuth_offset_point"
         "observables::pulsar::direction::magnetic_axis_direction"] []
    51 "pulsep" "pulsar period"
        ["observables::pulsar::period::azimuth_rate"
         "observables::pulsar::period::instantaneous_period" "observables::pulsar::period::approximate_period"
         "observables::pulsar::PulseTrain::periods"] []
    52 "" "rate of the azimuth relative to the line of nodes"
        ["observables::pulsar::period::azimuth_offset_rate"] []
    53 "" "pulse width"
        ["observables::pulsar::width::edge_azimuths" "observables::pulsar::width::PulseWidth"
         "observables::pulsar::PulseTrain::durations"] []
    54 "mninertial" "m.n in colatitudes and azimuths"
        ["observables::pulsar::direction::axis_along_line_of_sight_in_azimuth"] []
    55 "" "azimuths of the edges" ["observables::pulsar::width::edge_azimuths"] []
    56 "pulsewid" "pulse width at constant colatitude"
        ["observables::pulsar::width::pulse_width" "observables::pulsar::width::cosine_of_half_width"] []
    57 "tpconstant" "shifted rates" ["solutions::perturbation::shifted_rates"] ["perturbation_constants"]
    58 "" "estimate of t_c" ["star::estimates::time_unit_estimate"] ["star_estimates"]
    59 "" "quadrupole formula" ["observables::gravitational_wave::metric_perturbation"] []
    60 "" "I^{IJ} in the inertial frame" ["dynamics::wave_source::tensor_in_inertial_frame"] []
    61 "" "infinitesimal rotation of the body axes" ["dynamics::wave_source::rotation_rate"] []
    62 "1stdrmat" "rate of the rotation matrix" ["dynamics::wave_source::rotation_rate"] []
    63 "" "equation of motion with torque" ["dynamics::angular_acceleration::angular_acceleration"] []
    64 "" "ddot I^{IJ} = R R A"
        ["dynamics::wave_source::tensor_in_inertial_frame"
         "dynamics::wave_source::spheroid_inertia_acceleration"] []
    65 "gwa" "body-frame tensor A^ij" ["dynamics::wave_source::wave_tensor"] []
    66 "" "torque"
        ["dynamics::torque::torque_from_gradient"
         "dynamics::torque::torque_on_body" "dynamics::equations_of_motion::torque_on_axis"] []
    67 "" "differences of the moments of inertia" ["dynamics::PrincipalInertia::differences"] []
    68 "gwwf" "ddot I^{IJ} of free precession" ["dynamics::wave_source::free_inertia_acceleration"] []
    69 "" "polarization tensors" ["observables::gravitational_wave::polarization_tensors"] []
    70 "thphinertial" "basis normal to the line of sight" ["observables::Observer::at"] []
    71 "hpluscross" "h_+ and h_x"
        ["observables::gravitational_wave::polarizations" "observables::gravitational_wave::wave_of_state" "observables::gravitational_wave::Polarizations"
         "observables::gravitational_wave::strain_unit"] ["spectral_lines" "figure_waves" "figure_wave_spectra" "figure_line_atlas"]
    72 "ecc" "eccentricity" ["star::spheroid_shape::SpheroidShape"] []
    73 "" "interior potential of a uniform ellipsoid"
        ["star::ellipsoid::UniformEllipsoid" "star::potential_coefficients::PotentialCoefficients"] []
    74 "" "A_0, A_1, A_2, A_3"
        ["star::potential_coefficients::potential_coefficients"
         "star::ellipsoid::UniformEllipsoid::coefficients"] ["appendix_expansions"]
    75 "" "C of a uniform spheroid"
        ["star::uniform_spheroid::UniformSpheroid::c" "star::potential_coefficients::reduced_difference"]
         ["appendix_expansions"]
    76 "" "hydrostatic equilibrium" ["star::maclaurin::MaclaurinSpheroid::pressure"] []
    77 "" "rotation of a Maclaurin spheroid" ["star::maclaurin::MaclaurinSpheroid::new"] []
    78 "estc" "T_rot = 2 C" ["star::maclaurin::MaclaurinSpheroid::new"] []
    79 "" "oblateness from the eccentricity" ["star::spheroid_shape::SpheroidShape::oblateness"] []
}

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
    page
}
