//! Kernels with rational values, under the names of `verify/oracles/symbolic/quantities.py` and with its order of components.

use nalgebra::{Matrix3, Vector3};
use twofold::dynamics::angular_acceleration::angular_acceleration;
use twofold::dynamics::equations_of_motion::{angular_velocity, body_state_rates, torque_on_axis};
use twofold::dynamics::euler_angle_equations::{AxisAngles, euler_angle_accelerations, euler_angle_residuals};
use twofold::dynamics::first_integrals::{energy_in_angles, first_integrals, spin_in_angles};
use twofold::dynamics::kinetic_energy::{kinetic_energy, kinetic_energy_of_body};
use twofold::dynamics::lagrangian::lagrangian;
use twofold::dynamics::potential::{
    anisotropic_potential_in_angles, anisotropic_potential_of_axis, anisotropic_potential_of_body, nordtvedt_potential,
    potential_gradient_in_angles,
};
use twofold::dynamics::torque::{self, torque_on_body};
use twofold::dynamics::wave_source::{
    free_inertia_acceleration, rotation_rate, spheroid_inertia_acceleration, tensor_in_inertial_frame, wave_tensor,
};
use twofold::euler_angles::{body_from_inertial, body_rates, symmetry_axis, tensor_in_body_frame};
use twofold::observables::Observer;
use twofold::observables::bound::{cos_opening_angle, lambda_change_terms, zeta_change_terms};
use twofold::observables::gravitational_wave::{metric_perturbation, polarizations};
use twofold::observables::pulsar::Beam;
use twofold::observables::pulsar::beam::axis_along_line_of_sight;
use twofold::observables::pulsar::direction::{
    axis_along_line_of_sight_in_azimuth, azimuth_offset_point, cosine_of_colatitude,
};
use twofold::observables::pulsar::period::{azimuth_offset_rate, azimuth_rate};
use twofold::observables::pulsar::width::cosine_of_half_width;
use twofold::observables::spin_axis::{changes_from_start, cos_lambda_change, cos_lambda_in_angles, cos_lambda_rate};
use twofold::solutions::perturbation::linearised::{FirstOrderMotion, ZerothOrder, full_residuals, printed_residuals};
use twofold::solutions::perturbation::{Constants, Form, Perturbation, Precession};

use super::point::Coded;
use super::{RationalKernel, RationalPoint};

macro_rules! kernels {
    ($($name:literal => $kernel:ident),* $(,)?) => {
        /// All of them.
        pub(super) fn all() -> Vec<RationalKernel> {
            vec![$(RationalKernel { name: $name, field: $kernel, doubles: $kernel, conditioned: $kernel }),*]
        }
    };
}

kernels! {
    "rotation-matrix" => rotation_matrix,
    "symmetry-axis" => axis,
    "tensor-in-body-frame" => in_body_frame,
    "tensor-in-inertial-frame" => in_inertial_frame,
    "rotation-rate" => rate_of_rotation,
    "body-rates" => rates_in_body,
    "kinetic-energy" => kinetic,
    "kinetic-energy-of-body" => kinetic_of_body,
    "potential-in-angles" => potential_in_angles,
    "potential-of-axis" => potential_of_axis,
    "potential-of-body" => potential_of_body,
    "nordtvedt-potential" => nordtvedt,
    "potential-gradient" => potential_gradient,
    "lagrangian" => lagrange,
    "euler-angle-residuals" => residuals,
    "euler-angle-accelerations" => accelerations,
    "state-from-angles" => state,
    "state-rates" => state_rates,
    "energy" => energies,
    "spin" => spins,
    "third-integral" => third_integral,
    "torque-from-gradient" => torque_from_gradient,
    "torque-on-body" => on_body,
    "torque-on-axis" => on_axis,
    "angular-acceleration" => acceleration_of_body,
    "wave-tensor" => tensor_of_wave,
    "inertia-acceleration" => inertia_acceleration,
    "free-inertia-acceleration" => free_acceleration,
    "cos-lambda" => spin_axis,
    "observer" => observer_basis,
    "axis-along-line-of-sight" => along_line_of_sight,
    "magnetic-axis-direction" => magnetic_axis,
    "azimuth-rate" => azimuth_rates,
    "margin-rates" => margin_rates,
    "axis-in-azimuth" => in_azimuth,
    "cosine-of-half-width" => half_width,
    "cos-opening-angle" => opening,
    "width-changes" => width_changes,
    "polarizations" => polarized,
    "first-order-equations-twofold" => full_twofold,
    "first-order-equations-single" => full_single,
    "printed-first-order-equations-twofold" => printed_twofold,
    "printed-first-order-equations-single" => printed_single,
    "printed-solution-twofold" => solution_twofold,
    "printed-solution-single" => solution_single,
    "corrected-solution-twofold" => corrected_twofold,
    "corrected-solution-single" => corrected_single,
}

type Point<F> = RationalPoint<F>;

/// Row by row.
fn flat<F: Coded>(m: &Matrix3<F>) -> Vec<F> {
    m.transpose().iter().copied().collect()
}

fn components<F: Coded>(v: &Vector3<F>) -> Vec<F> {
    v.iter().copied().collect()
}

fn rotation_matrix<F: Coded>(p: &Point<F>) -> Vec<F> {
    flat(&body_from_inertial(&p.angles()))
}

fn axis<F: Coded>(p: &Point<F>) -> Vec<F> {
    components(&symmetry_axis(p.at("alpha"), p.at("beta")))
}

fn in_body_frame<F: Coded>(p: &Point<F>) -> Vec<F> {
    flat(&tensor_in_body_frame(&body_from_inertial(&p.angles()), &p.symmetric("S")))
}

fn in_inertial_frame<F: Coded>(p: &Point<F>) -> Vec<F> {
    flat(&tensor_in_inertial_frame(&body_from_inertial(&p.angles()), &p.symmetric("S")))
}

fn rate_of_rotation<F: Coded>(p: &Point<F>) -> Vec<F> {
    let rotation = body_from_inertial(&p.angles());
    flat(&rotation_rate(&rotation, &(rotation.transpose() * body_rates(&p.angles(), &p.rates()))))
}

fn rates_in_body<F: Coded>(p: &Point<F>) -> Vec<F> {
    components(&body_rates(&p.angles(), &p.rates()))
}

fn kinetic<F: Coded>(p: &Point<F>) -> Vec<F> {
    vec![kinetic_energy(&p.spheroid(), p.at("beta"), &p.rates())]
}

fn kinetic_of_body<F: Coded>(p: &Point<F>) -> Vec<F> {
    vec![kinetic_energy_of_body(&p.body(), &p.vector(["w_1", "w_2", "w_3"]))]
}

fn potential_in_angles<F: Coded>(p: &Point<F>) -> Vec<F> {
    vec![anisotropic_potential_in_angles(p.at("c"), &p.coefficients(), p.at("alpha"), p.at("beta"))]
}

fn potential_of_axis<F: Coded>(p: &Point<F>) -> Vec<F> {
    vec![anisotropic_potential_of_axis(p.at("c"), &p.symmetric("S"), &symmetry_axis(p.at("alpha"), p.at("beta")))]
}

fn potential_of_body<F: Coded>(p: &Point<F>) -> Vec<F> {
    vec![anisotropic_potential_of_body(&p.symmetric("S"), &p.symmetric("u"))]
}

fn nordtvedt<F: Coded>(p: &Point<F>) -> Vec<F> {
    let axis = symmetry_axis(p.at("alpha"), p.at("beta"));
    vec![nordtvedt_potential(p.at("x_4"), p.at("spin"), &p.vector(["x_1", "x_2", "x_3"]), &axis)]
}

fn gradient<F: Coded>(p: &Point<F>) -> (F, F) {
    potential_gradient_in_angles(p.at("c"), &p.coefficients(), p.at("alpha"), p.at("beta"))
}

fn potential_gradient<F: Coded>(p: &Point<F>) -> Vec<F> {
    let (by_alpha, by_beta) = gradient(p);
    vec![by_alpha, by_beta]
}

fn lagrange<F: Coded>(p: &Point<F>) -> Vec<F> {
    vec![lagrangian(&p.spheroid(), &p.coefficients(), &p.angles(), &p.rates())]
}

fn axis_angles<F: Coded>(p: &Point<F>) -> AxisAngles<F> {
    let [alpha, beta, alpha_rate, beta_rate] = ["alpha", "beta", "alpha_1", "beta_1"].map(|name| p.at(name));
    AxisAngles { alpha, beta, alpha_rate, beta_rate }
}

fn residuals<F: Coded>(p: &Point<F>) -> Vec<F> {
    let accelerations = (p.at("alpha_2"), p.at("beta_2"));
    let (alpha, beta) =
        euler_angle_residuals(&p.spheroid(), &p.coefficients(), p.at("spin"), &axis_angles(p), accelerations);
    vec![alpha, beta]
}

fn accelerations<F: Coded>(p: &Point<F>) -> Vec<F> {
    let (alpha, beta) = euler_angle_accelerations(&p.spheroid(), &p.coefficients(), p.at("spin"), &axis_angles(p));
    vec![alpha, beta]
}

fn state<F: Coded>(p: &Point<F>) -> Vec<F> {
    let state = p.state();
    [components(&state.axis), components(&state.momentum), components(&state.equatorial_axis)].concat()
}

fn state_rates<F: Coded>(p: &Point<F>) -> Vec<F> {
    let rates = body_state_rates(&p.spheroid(), &p.coefficients().tensor(), &p.state());
    [components(&rates.axis), components(&rates.momentum), components(&rates.equatorial_axis)].concat()
}

fn energies<F: Coded>(p: &Point<F>) -> Vec<F> {
    let s = p.coefficients();
    let of_state = first_integrals(&p.spheroid(), &s.tensor(), &p.state()).energy;
    vec![energy_in_angles(&p.spheroid(), &s, &p.angles(), &p.rates()), of_state]
}

fn spins<F: Coded>(p: &Point<F>) -> Vec<F> {
    let of_state = first_integrals(&p.spheroid(), &p.coefficients().tensor(), &p.state()).spin;
    vec![spin_in_angles(&p.angles(), &p.rates()), of_state]
}

fn third_integral<F: Coded>(p: &Point<F>) -> Vec<F> {
    vec![first_integrals(&p.spheroid(), &p.coefficients().tensor(), &p.state()).clebsch]
}

fn torque_from_gradient<F: Coded>(p: &Point<F>) -> Vec<F> {
    components(&torque::torque_from_gradient(&p.angles(), &p.vector(["g_1", "g_2", "g_3"])))
}

fn on_body<F: Coded>(p: &Point<F>) -> Vec<F> {
    components(&torque_on_body(&p.symmetric("S"), &p.symmetric("u")))
}

fn on_axis<F: Coded>(p: &Point<F>) -> Vec<F> {
    components(&torque_on_axis(p.at("c"), &p.symmetric("S"), &symmetry_axis(p.at("alpha"), p.at("beta"))))
}

fn acceleration_of_body<F: Coded>(p: &Point<F>) -> Vec<F> {
    let [omega, torque] = [["w_1", "w_2", "w_3"], ["g_1", "g_2", "g_3"]].map(|names| p.vector(names));
    components(&angular_acceleration(&p.body(), &omega, &torque))
}

fn tensor_of_wave<F: Coded>(p: &Point<F>) -> Vec<F> {
    let [omega, torque] = [["w_1", "w_2", "w_3"], ["g_1", "g_2", "g_3"]].map(|names| p.vector(names));
    flat(&wave_tensor(&p.body(), &omega, &torque))
}

/// By the symmetry axis and the angular momentum, and by the tensor A^ij of the body.
fn inertia_acceleration<F: Coded>(p: &Point<F>) -> Vec<F> {
    let (spheroid, s, state) = (p.spheroid(), p.coefficients().tensor(), p.state());
    let direct = spheroid_inertia_acceleration(&spheroid, &s, &state.axis, &state.momentum);
    let rotation = body_from_inertial(&p.angles());
    let (by_alpha, by_beta) = gradient(p);
    let torque = torque::torque_from_gradient(&p.angles(), &Vector3::new(by_alpha, by_beta, F::zero()));
    let in_body = wave_tensor(&spheroid.inertia(), &body_rates(&p.angles(), &p.rates()), &torque);
    [flat(&direct), flat(&tensor_in_inertial_frame(&rotation, &in_body))].concat()
}

fn free_acceleration<F: Coded>(p: &Point<F>) -> Vec<F> {
    flat(&free_inertia_acceleration(&p.spheroid(), p.at("alpha"), p.at("beta"), p.at("alpha_1")))
}

fn observer<F: Coded>(p: &Point<F>) -> Observer<F> {
    Observer::at(p.at("theta_o"), p.at("phi_o"))
}

fn spin_axis<F: Coded>(p: &Point<F>) -> Vec<F> {
    let [theta_o, phi_o, alpha, beta] = ["theta_o", "phi_o", "alpha", "beta"].map(|name| p.at(name));
    let (state, to_observer) = (p.state(), observer(p).direction);
    vec![
        cos_lambda_in_angles(theta_o, phi_o, alpha, beta),
        to_observer.dot(&state.axis),
        cos_lambda_change(theta_o, phi_o, (alpha, beta), (p.at("x_1"), p.at("x_2"))),
        cos_lambda_rate(&p.spheroid(), &to_observer, &state.axis, &state.momentum),
    ]
}

fn observer_basis<F: Coded>(p: &Point<F>) -> Vec<F> {
    let Observer { direction, theta_hat, phi_hat } = observer(p);
    [direction, theta_hat, phi_hat].iter().flat_map(components).collect()
}

fn beam<F: Coded>(p: &Point<F>) -> Beam<F> {
    Beam::new(p.at("chi"), p.at("delta"), p.at("half_opening"))
}

fn along_line_of_sight<F: Coded>(p: &Point<F>) -> Vec<F> {
    let [chi, delta, theta_o, phi_o] = ["chi", "delta", "theta_o", "phi_o"].map(|name| p.at(name));
    vec![axis_along_line_of_sight(&p.angles(), chi, delta, theta_o, phi_o)]
}

fn magnetic_axis<F: Coded>(p: &Point<F>) -> Vec<F> {
    let [beta, gamma, chi, delta] = ["beta", "gamma", "chi", "delta"].map(|name| p.at(name));
    let (x, y) = azimuth_offset_point(beta, gamma, chi, delta);
    vec![cosine_of_colatitude(beta, gamma, chi, delta), x, y]
}

fn azimuth_rates<F: Coded>(p: &Point<F>) -> Vec<F> {
    let state = p.state();
    let omega = angular_velocity(&p.spheroid(), &state.axis, &state.momentum);
    let [beta, gamma, chi, delta] = ["beta", "gamma", "chi", "delta"].map(|name| p.at(name));
    vec![
        azimuth_rate(&beam(p).direction(&state), &omega),
        azimuth_offset_rate(beta, gamma, p.at("gamma_1"), chi, delta),
    ]
}

fn margin_rates<F: Coded>(p: &Point<F>) -> Vec<F> {
    let tensor = p.coefficients().tensor();
    beam(p).margin_rates(&p.spheroid(), &tensor, &p.state(), &observer(p).direction).to_vec()
}

fn in_azimuth<F: Coded>(p: &Point<F>) -> Vec<F> {
    let [theta, phi, theta_o, phi_o] = ["colatitude", "azimuth", "theta_o", "phi_o"].map(|name| p.at(name));
    vec![axis_along_line_of_sight_in_azimuth(theta, phi, theta_o, phi_o)]
}

fn half_width<F: Coded>(p: &Point<F>) -> Vec<F> {
    vec![cosine_of_half_width(p.at("half_opening"), p.at("colatitude"), p.at("theta_o"))]
}

/// Twice the angle whose half is asked for: halved again it has the same code.
fn width<F: Coded>(p: &Point<F>) -> F {
    p.at("half_width") * 2.0
}

fn opening<F: Coded>(p: &Point<F>) -> Vec<F> {
    vec![cos_opening_angle(p.at("zeta"), p.at("chi"), width(p))]
}

fn width_changes<F: Coded>(p: &Point<F>) -> Vec<F> {
    let terms = [zeta_change_terms, lambda_change_terms];
    terms.map(|terms| terms(p.at("zeta"), p.at("chi"), width(p))).map(|[above, below]| above / below).to_vec()
}

fn polarized<F: Coded>(p: &Point<F>) -> Vec<F> {
    let h = polarizations(&observer(p), &metric_perturbation(p.at("distance"), &p.symmetric("S")));
    vec![h.plus, h.cross]
}

type Residuals<F> = fn(
    &twofold::dynamics::RigidSpheroid<F>,
    &twofold::lorentz_violation::PrincipalCoefficients<F>,
    &ZerothOrder<F>,
    &FirstOrderMotion<F>,
) -> (F, F);

fn first_order<F: Coded>(p: &Point<F>, kind: Precession, residuals: Residuals<F>) -> Vec<F> {
    let zeroth = ZerothOrder { kind, spin: p.at("spin"), alpha: p.at("alpha"), beta: p.at("beta") };
    let [beta, alpha_rate, beta_rate, alpha_acceleration, beta_acceleration] =
        ["x_1", "x_2", "x_3", "x_4", "x_5"].map(|name| p.at(name));
    let first = FirstOrderMotion { beta, alpha_rate, beta_rate, alpha_acceleration, beta_acceleration };
    let (along_alpha, along_beta) = residuals(&p.spheroid(), &p.coefficients(), &zeroth, &first);
    vec![along_alpha, along_beta]
}

fn full_twofold<F: Coded>(p: &Point<F>) -> Vec<F> {
    first_order(p, Precession::Twofold, full_residuals)
}

fn full_single<F: Coded>(p: &Point<F>) -> Vec<F> {
    first_order(p, Precession::Single, full_residuals)
}

fn printed_twofold<F: Coded>(p: &Point<F>) -> Vec<F> {
    first_order(p, Precession::Twofold, printed_residuals)
}

fn printed_single<F: Coded>(p: &Point<F>) -> Vec<F> {
    first_order(p, Precession::Single, printed_residuals)
}

fn constants<F: Coded>(p: &Point<F>) -> Constants<F> {
    Constants { alpha_0: p.at("y"), beta_0: p.at("beta"), amplitude: p.at("amplitude"), phase: p.at("x") }
}

/// Numbers, angles and rates at the phases `x` and `y`, and the changes in the time `x_1` after the start, where these are the phases.
fn solved<F: Coded>(p: &Point<F>, solution: &Perturbation<F>) -> Vec<F> {
    let (alpha, beta) = solution.first_order(p.at("x"), p.at("y"));
    let (alpha_rate, beta_rate) = solution.first_order_rates(p.at("x"), p.at("y"));
    let (alpha_change, beta_change) = changes_from_start(solution, p.at("x_1"));
    vec![
        solution.omega,
        solution.rate,
        solution.zeroth_rate,
        solution.forced_rate,
        solution.c_tilde,
        solution.eta_alpha,
        solution.eta_beta,
        solution.homogeneous_frequency,
        solution.homogeneous_ratio,
        alpha,
        beta,
        alpha_rate,
        beta_rate,
        alpha_change,
        beta_change,
    ]
}

fn solution<F: Coded>(p: &Point<F>, form: Form, kind: Precession) -> Vec<F> {
    solved(p, &Perturbation::new_unchecked(form, kind, &p.spheroid(), &p.coefficients(), p.at("spin"), &constants(p)))
}

fn solution_twofold<F: Coded>(p: &Point<F>) -> Vec<F> {
    solution(p, Form::Printed, Precession::Twofold)
}

fn solution_single<F: Coded>(p: &Point<F>) -> Vec<F> {
    solution(p, Form::Printed, Precession::Single)
}

fn corrected_twofold<F: Coded>(p: &Point<F>) -> Vec<F> {
    solution(p, Form::Corrected, Precession::Twofold)
}

fn corrected_single<F: Coded>(p: &Point<F>) -> Vec<F> {
    solution(p, Form::Corrected, Precession::Single)
}
