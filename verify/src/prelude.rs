//! The names that most checks use: parts of a problem, common kernels, and the functions that measure figures.

pub(crate) use crate::check::{
    Bound, Check, Figure, Kind, Measured, Outcome, Worst, checks, largest, largest_component, largest_difference,
    largest_if_any, largest_of, least_of, smallest, worst_of,
};
pub(crate) use crate::derivation::spheroid_motion::fixed_spheroid;
pub(crate) use crate::derivation::{Differentiable, components, moving_angles, moving_rates};
pub(crate) use crate::double_double::DoubleDouble;
pub(crate) use crate::error_scenes::ErrorScene;
pub(crate) use crate::magnitudes::Conditioned;
pub(crate) use crate::measured_order::{errors_at, largest_off_order, measured_order, order_of_error};
pub(crate) use crate::paper_examples::{COEFFICIENTS, SPIN, paper_examples, spheroid};
pub(crate) use crate::physical_domain::{RandomScene, scenes, worst_over};
pub(crate) use crate::prime_field::Fp;
pub(crate) use crate::random::{Point, Random, worst_of_draws};
pub(crate) use crate::reference::{reference_motion, reference_motions};
pub(crate) use core::f64::consts::{FRAC_PI_2, PI, TAU};
pub(crate) use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Vector3};
pub(crate) use num_dual::{Dual2_64, Dual64};
pub(crate) use num_traits::Zero;
pub(crate) use std::collections::BTreeMap;
pub(crate) use twofold::dynamics::angular_acceleration::angular_acceleration;
pub(crate) use twofold::dynamics::equations_of_motion::{
    angular_velocity, body_state_rates, reduced_rates, torque_on_axis,
};
pub(crate) use twofold::dynamics::euler_angle_equations::{
    AxisAngles, euler_angle_accelerations, euler_angle_residuals,
};
pub(crate) use twofold::dynamics::first_integrals::{
    FirstIntegrals, energy_in_angles, first_integrals, spin_in_angles, symmetric_adjugate,
};
pub(crate) use twofold::dynamics::kinetic_energy::{kinetic_energy, kinetic_energy_of_body};
pub(crate) use twofold::dynamics::lagrangian::lagrangian;
pub(crate) use twofold::dynamics::point_masses::anisotropic_potential_of_masses;
pub(crate) use twofold::dynamics::potential::{
    anisotropic_potential_in_angles, anisotropic_potential_of_axis, anisotropic_potential_of_body, nordtvedt_potential,
    potential_gradient_in_angles,
};
pub(crate) use twofold::dynamics::torque::{torque_from_gradient, torque_on_body};
pub(crate) use twofold::dynamics::wave_source::{
    free_inertia_acceleration, rotation_rate, spheroid_inertia_acceleration, tensor_in_inertial_frame, wave_tensor,
};
pub(crate) use twofold::dynamics::{AxisState, BodyState, PrincipalInertia, Problem, RigidSpheroid, RotationState};
pub(crate) use twofold::euler_angles::{
    EulerAngles, EulerRates, body_from_inertial, body_rates, permuted_from_inertial, symmetry_axis,
    tensor_in_body_frame,
};
pub(crate) use twofold::field_operators;
pub(crate) use twofold::inference::{Fisher, InferenceError, Observable, Signal, data_of};
pub(crate) use twofold::lorentz_violation::{
    PrincipalCoefficients, coefficients_from_preferred_frame, principal_frame,
};
pub(crate) use twofold::numerics::angle::wrapped;
pub(crate) use twofold::numerics::elliptic::jacobi::complete_integral;
pub(crate) use twofold::observables::Observer;
pub(crate) use twofold::observables::bound::{
    SpinAxisDrift, cos_opening_angle, eta_from_inclination, fluid_inertia_over_c, zeta_change_terms,
};
pub(crate) use twofold::observables::eta::secular_axis_rate;
pub(crate) use twofold::observables::eta_distribution::{EtaDistribution, SpinAxis, root_mean_square_along_motion};
pub(crate) use twofold::observables::gravitational_wave::{metric_perturbation, polarizations};
pub(crate) use twofold::observables::pulsar::beam::axis_along_line_of_sight;
pub(crate) use twofold::observables::pulsar::direction::{
    axis_along_line_of_sight_in_azimuth, azimuth_offset_point, cosine_of_colatitude, magnetic_axis_direction,
};
pub(crate) use twofold::observables::pulsar::period::{
    approximate_period, azimuth_offset_rate, azimuth_rate, instantaneous_period,
};
pub(crate) use twofold::observables::pulsar::width::{PulseWidth, cosine_of_half_width, pulse_width};
pub(crate) use twofold::observables::pulsar::{Arrival, Beam, ConstantPeriod, Stamped, arrivals, pulse_train};
pub(crate) use twofold::observables::spectrum::{LineList, QuasiPeriodicMotion, SpectralLine};
pub(crate) use twofold::observables::spin_axis::{
    changes_from_start, cos_lambda_change, cos_lambda_in_angles, cos_lambda_rate,
};
pub(crate) use twofold::parameters::{Parameter, Parameters};
pub(crate) use twofold::plan::Method;
pub(crate) use twofold::propagation::{AveragedMotion, ContinuousAngles, Motion, TaylorMotion};
pub(crate) use twofold::solutions::averaged::{
    AveragedSolution, AveragingOrder, generator, generator_slopes, mean_angular_velocity, mean_potential,
    middle_axis_growth,
};
pub(crate) use twofold::solutions::free::{free_precession_rates, free_rotation};
pub(crate) use twofold::solutions::perturbation::linearised::{
    FirstOrderMotion, ZerothOrder, full_residuals, printed_residuals,
};
pub(crate) use twofold::solutions::perturbation::{Constants, Form, Perturbation, Precession, shifted_rates};
pub(crate) use twofold::solutions::steady::steady_precession_rate;
pub(crate) use twofold::solutions::symmetric::SymmetricSolution;
pub(crate) use twofold::solutions::torus::states_with_integrals;
pub(crate) use twofold::star::deformation::{centrifugal_oblateness, centrifugal_oblateness_scaled};
pub(crate) use twofold::star::estimates::{inertia_over_c_estimate, time_unit_estimate};
pub(crate) use twofold::star::maclaurin::MaclaurinSpheroid;
pub(crate) use twofold::star::potential_coefficients::potential_coefficients;
pub(crate) use twofold::star::spheroid_shape::SpheroidShape;
pub(crate) use twofold::star::uniform_spheroid::UniformSpheroid;
pub(crate) use twofold::units::si;
pub(crate) use twofold::{Error, Real, Scalar};
pub(crate) use twofold_scene::scene_file::Scene;
