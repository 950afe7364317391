//! Kernels with rational values, with the names and the order of components of `verify/oracles/symbolic/quantities.py`.

use twofold::dynamics::bulge::{bulge_potential, bulge_turning, kinematic_momentum};
use twofold::observables::bound::lambda_change_terms;
use twofold::spin_down::TorqueHarmonics;

use super::point::Coded;
use super::{RationalKernel, RationalPoint};
use crate::prelude::*;

/// Defines each kernel once, for every type of numbers.
macro_rules! kernels {
    ($($name:literal => |$point:ident| $values:expr;)*) => {
        /// All of them.
        pub(super) fn all() -> Vec<RationalKernel> {
            vec![$({
                fn kernel<F: Coded>($point: &RationalPoint<F>) -> Vec<F> {
                    components![$values]
                }
                RationalKernel { name: $name, field: kernel, doubles: kernel, conditioned: kernel }
            }),*]
        }
    };
}

kernels! {
    "rotation-matrix" => |p| flat(&body_from_inertial(&p.angles()));
    "symmetry-axis" => |p| symmetry_axis(p.at("alpha"), p.at("beta"));
    "tensor-in-body-frame" => |p| flat(&tensor_in_body_frame(&body_from_inertial(&p.angles()), &p.symmetric("S")));
    "tensor-in-inertial-frame" => |p| {
        flat(&tensor_in_inertial_frame(&body_from_inertial(&p.angles()), &p.symmetric("S")))
    };
    "rotation-rate" => |p| {
        let rotation = body_from_inertial(&p.angles());
        flat(&rotation_rate(&rotation, &(rotation.transpose() * body_rates(&p.angles(), &p.rates()))))
    };
    "body-rates" => |p| body_rates(&p.angles(), &p.rates());
    "kinetic-energy" => |p| [kinetic_energy(&p.spheroid(), p.at("beta"), &p.rates())];
    "kinetic-energy-of-body" => |p| [kinetic_energy_of_body(&p.body(), &p.vector(["w_1", "w_2", "w_3"]))];
    "potential-in-angles" => |p| {
        [anisotropic_potential_in_angles(p.at("c"), &p.coefficients(), p.at("alpha"), p.at("beta"))]
    };
    "potential-of-axis" => |p| {
        [anisotropic_potential_of_axis(p.at("c"), &p.symmetric("S"), &symmetry_axis(p.at("alpha"), p.at("beta")))]
    };
    "potential-of-body" => |p| [anisotropic_potential_of_body(&p.symmetric("S"), &p.symmetric("u"))];
    "nordtvedt-potential" => |p| {
        let axis = symmetry_axis(p.at("alpha"), p.at("beta"));
        [nordtvedt_potential(p.at("x_4"), p.at("spin"), &p.vector(["x_1", "x_2", "x_3"]), &axis)]
    };
    "potential-gradient" => |p| gradient(p);
    "lagrangian" => |p| [lagrangian(&p.spheroid(), &p.coefficients(), &p.angles(), &p.rates())];
    "euler-angle-residuals" => |p| {
        let accelerations = (p.at("alpha_2"), p.at("beta_2"));
        euler_angle_residuals(&p.spheroid(), &p.coefficients(), p.at("spin"), &axis_angles(p), accelerations)
    };
    "euler-angle-accelerations" => |p| {
        euler_angle_accelerations(&p.spheroid(), &p.coefficients(), p.at("spin"), &axis_angles(p))
    };
    "state-from-angles" => |p| p.state().vectors();
    "state-rates" => |p| body_state_rates(&p.spheroid(), &p.coefficients().tensor(), &p.state()).vectors();
    "energy" => |p| {
        let s = p.coefficients();
        let of_state = first_integrals(&p.spheroid(), &s.tensor(), &p.state()).energy;
        [energy_in_angles(&p.spheroid(), &s, &p.angles(), &p.rates()), of_state]
    };
    "spin" => |p| {
        let of_state = first_integrals(&p.spheroid(), &p.coefficients().tensor(), &p.state()).spin;
        [spin_in_angles(&p.angles(), &p.rates()), of_state]
    };
    "third-integral" => |p| [first_integrals(&p.spheroid(), &p.coefficients().tensor(), &p.state()).clebsch];
    "torque-from-gradient" => |p| {
        torque_from_gradient(&p.angles(), &p.vector(["g_1", "g_2", "g_3"]))
    };
    "torque-on-body" => |p| torque_on_body(&p.symmetric("S"), &p.symmetric("u"));
    "torque-on-axis" => |p| {
        torque_on_axis(p.at("c"), &p.symmetric("S"), &symmetry_axis(p.at("alpha"), p.at("beta")))
    };
    "angular-acceleration" => |p| {
        let [omega, torque] = [["w_1", "w_2", "w_3"], ["g_1", "g_2", "g_3"]].map(|names| p.vector(names));
        angular_acceleration(&p.body(), &omega, &torque)
    };
    "wave-tensor" => |p| {
        let [omega, torque] = [["w_1", "w_2", "w_3"], ["g_1", "g_2", "g_3"]].map(|names| p.vector(names));
        flat(&wave_tensor(&p.body(), &omega, &torque))
    };
    // From the symmetry axis and the angular momentum, and from the tensor A^ij of the body.
    "inertia-acceleration" => |p| {
        let (spheroid, s, state) = (p.spheroid(), p.coefficients().tensor(), p.state());
        let direct = spheroid_inertia_acceleration(&spheroid, &s, &state.axis, &state.momentum);
        let rotation = body_from_inertial(&p.angles());
        let (by_alpha, by_beta) = gradient(p);
        let torque = torque_from_gradient(&p.angles(), &Vector3::new(by_alpha, by_beta, F::zero()));
        let in_body = wave_tensor(&spheroid.inertia(), &body_rates(&p.angles(), &p.rates()), &torque);
        [flat(&direct), flat(&tensor_in_inertial_frame(&rotation, &in_body))]
    };
    "free-inertia-acceleration" => |p| {
        flat(&free_inertia_acceleration(&p.spheroid(), p.at("alpha"), p.at("beta"), p.at("alpha_1")))
    };
    "cos-lambda" => |p| {
        let [theta_o, phi_o, alpha, beta] = ["theta_o", "phi_o", "alpha", "beta"].map(|name| p.at(name));
        let (state, to_observer) = (p.state(), observer(p).direction);
        [
            cos_lambda_in_angles(theta_o, phi_o, alpha, beta),
            to_observer.dot(&state.axis),
            cos_lambda_change(theta_o, phi_o, (alpha, beta), (p.at("x_1"), p.at("x_2"))),
            cos_lambda_rate(&p.spheroid(), &to_observer, &state.axis, &state.momentum),
        ]
    };
    "observer" => |p| {
        let Observer { direction, theta_hat, phi_hat } = observer(p);
        [direction, theta_hat, phi_hat]
    };
    "axis-along-line-of-sight" => |p| {
        let [chi, delta, theta_o, phi_o] = ["chi", "delta", "theta_o", "phi_o"].map(|name| p.at(name));
        [axis_along_line_of_sight(&p.angles(), chi, delta, theta_o, phi_o)]
    };
    "magnetic-axis-direction" => |p| {
        let [beta, gamma, chi, delta] = ["beta", "gamma", "chi", "delta"].map(|name| p.at(name));
        let (x, y) = azimuth_offset_point(beta, gamma, chi, delta);
        [cosine_of_colatitude(beta, gamma, chi, delta), x, y]
    };
    "azimuth-rate" => |p| {
        let state = p.state();
        let omega = angular_velocity(&p.spheroid(), &state.axis, &state.momentum);
        let [beta, gamma, chi, delta] = ["beta", "gamma", "chi", "delta"].map(|name| p.at(name));
        [
            azimuth_rate(&beam(p).direction(&state), &omega),
            azimuth_offset_rate(beta, gamma, p.at("gamma_1"), chi, delta),
        ]
    };
    "margin-rates" => |p| {
        let tensor = p.coefficients().tensor();
        beam(p).margin_rates(&p.spheroid(), &tensor, F::zero(), &p.state(), &observer(p).direction)
    };
    "axis-in-azimuth" => |p| {
        let [theta, phi, theta_o, phi_o] = ["colatitude", "azimuth", "theta_o", "phi_o"].map(|name| p.at(name));
        [axis_along_line_of_sight_in_azimuth(theta, phi, theta_o, phi_o)]
    };
    "cosine-of-half-width" => |p| [cosine_of_half_width(p.at("half_opening"), p.at("colatitude"), p.at("theta_o"))];
    "cos-opening-angle" => |p| [cos_opening_angle(p.at("zeta"), p.at("chi"), width(p))];
    "width-changes" => |p| {
        let terms = [zeta_change_terms, lambda_change_terms];
        terms.map(|terms| terms(p.at("zeta"), p.at("chi"), width(p))).map(|[above, below]| above / below)
    };
    "polarizations" => |p| {
        let h = polarizations(&observer(p), &metric_perturbation(p.at("distance"), &p.symmetric("S")));
        [h.plus, h.cross]
    };
    "first-order-equations-twofold" => |p| first_order(p, Precession::Twofold, full_residuals);
    "first-order-equations-single" => |p| first_order(p, Precession::Single, full_residuals);
    "printed-first-order-equations-twofold" => |p| first_order(p, Precession::Twofold, printed_residuals);
    "printed-first-order-equations-single" => |p| first_order(p, Precession::Single, printed_residuals);
    "printed-solution-twofold" => |p| solution(p, Form::Printed, Precession::Twofold);
    "printed-solution-single" => |p| solution(p, Form::Printed, Precession::Single);
    "corrected-solution-twofold" => |p| solution(p, Form::Corrected, Precession::Twofold);
    "corrected-solution-single" => |p| solution(p, Form::Corrected, Precession::Single);
    "bulge" => |p| {
        let (bulge, tensor) = (p.at("x_1"), p.symmetric("S"));
        let state = AxisState {
            axis: symmetry_axis(p.at("alpha"), p.at("beta")),
            momentum: p.vector(["w_1", "w_2", "w_3"]),
        };
        let turning = bulge_turning(bulge, &tensor, &state.momentum);
        components![
            [bulge_potential(bulge, &tensor, &state.momentum)],
            turning,
            turning.cross(&state.axis),
            turning.cross(&state.momentum),
            kinematic_momentum(&p.spheroid(), &tensor, bulge, &state)
        ]
    };
    "torque-harmonics" => |p| {
        let TorqueHarmonics { constant, once, twice } = TorqueHarmonics::new(p.at("colatitude"), p.at("chi"));
        [constant, once, twice]
    };
}

type Point<F> = RationalPoint<F>;

/// Row by row.
fn flat<F: Coded>(m: &Matrix3<F>) -> Matrix3<F> {
    m.transpose()
}

fn gradient<F: Coded>(p: &Point<F>) -> (F, F) {
    potential_gradient_in_angles(p.at("c"), &p.coefficients(), p.at("alpha"), p.at("beta"))
}

fn axis_angles<F: Coded>(p: &Point<F>) -> AxisAngles<F> {
    let [alpha, beta, alpha_rate, beta_rate] = ["alpha", "beta", "alpha_1", "beta_1"].map(|name| p.at(name));
    AxisAngles { alpha, beta, alpha_rate, beta_rate }
}

fn observer<F: Coded>(p: &Point<F>) -> Observer<F> {
    Observer::at(p.at("theta_o"), p.at("phi_o"))
}

fn beam<F: Coded>(p: &Point<F>) -> Beam<F> {
    Beam::new(p.at("chi"), p.at("delta"), p.at("half_opening"))
}

/// Twice the angle: its half, which the kernel takes, has the same code.
fn width<F: Coded>(p: &Point<F>) -> F {
    p.at("half_width") * 2.0
}

type Residuals<F> = fn(
    &twofold::dynamics::RigidSpheroid<F>,
    &twofold::lorentz_violation::PrincipalCoefficients<F>,
    &ZerothOrder<F>,
    &FirstOrderMotion<F>,
) -> (F, F);

fn first_order<F: Coded>(p: &Point<F>, kind: Precession, residuals: Residuals<F>) -> (F, F) {
    let zeroth = ZerothOrder { kind, spin: p.at("spin"), alpha: p.at("alpha"), beta: p.at("beta") };
    let [beta, alpha_rate, beta_rate, alpha_acceleration, beta_acceleration] =
        ["x_1", "x_2", "x_3", "x_4", "x_5"].map(|name| p.at(name));
    let first = FirstOrderMotion { beta, alpha_rate, beta_rate, alpha_acceleration, beta_acceleration };
    residuals(&p.spheroid(), &p.coefficients(), &zeroth, &first)
}

/// Constants, angles and rates at the phases `x` and `y`, and the changes in the time `x_1` after the start, where these are the phases.
fn solution<F: Coded>(p: &Point<F>, form: Form, kind: Precession) -> Vec<F> {
    let (phase, alpha_0) = (p.at("x"), p.at("y"));
    let constants = Constants { alpha_0, beta_0: p.at("beta"), amplitude: p.at("amplitude"), phase };
    let solution = Perturbation::new_unchecked(form, kind, &p.spheroid(), &p.coefficients(), p.at("spin"), &constants);
    components![
        [solution.omega, solution.rate, solution.zeroth_rate, solution.forced_rate, solution.c_tilde],
        [solution.eta_alpha, solution.eta_beta, solution.homogeneous_frequency, solution.homogeneous_ratio],
        solution.first_order(phase, alpha_0),
        solution.first_order_rates(phase, alpha_0),
        changes_from_start(&solution, p.at("x_1")),
    ]
}
