//! Potential and kinetic energy in Euler angles from their coordinate-free forms. Eqs. (5)-(7), (11), (13),
//! (21)-(23).

use nalgebra::{Matrix3, Vector3};
use twofold::dynamics::kinetic_energy::{kinetic_energy, kinetic_energy_of_body};
use twofold::dynamics::potential::{
    anisotropic_potential, anisotropic_potential_in_angles, anisotropic_potential_of_axis,
    anisotropic_potential_of_body, nordtvedt_potential, potential_gradient_in_angles,
};
use twofold::euler_angles::{body_from_inertial, body_rates, symmetry_axis, tensor_in_body_frame};
use twofold::lorentz_violation::{PrincipalCoefficients, coefficients_from_preferred_frame};

use crate::check::{Bound, Check, Kind, Measured};
use crate::derivation::Differentiable;
use crate::identity::{self, Identity};
use crate::measured_order::measured_order;
use crate::random::Point;

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    let mut checks = [
        identity::checks::<PotentialInAngles>(),
        identity::checks::<PotentialGradient>(),
        identity::checks::<PotentialOfBody>(),
        identity::checks::<NordtvedtForm>(),
        identity::checks::<KineticEnergy>(),
    ]
    .concat();
    checks.push(Check {
        id: "nordtvedt-form-needs-alignment",
        kind: Kind::Regime,
        equations: &[11, 13],
        statement: "Nordtvedt's form differs from delta U = C s^zz to first order in the angle between angular velocity and axis",
        figure: "slope of log(difference / C) against log of that angle, 1e-1 to 1e-5 rad",
        bound: Bound::Within(0.95, 1.05),
        reason: "one form has the direction of the angular velocity where the other has the axis; an integer order to 0.05",
        measure: misaligned_nordtvedt,
    });
    checks
}

/// Both forms for a star that turns about a direction at an angle from its axis, `w` at 0.6 rad from the axis.
fn misaligned_nordtvedt() -> Result<Measured, String> {
    let w = symmetry_axis(0.0, 0.6);
    let s = coefficients_from_preferred_frame(1.0, &w);
    let points = [1e-1_f64, 1e-2, 1e-3, 1e-4, 1e-5].map(|angle| {
        let (axis, angular_velocity) = (Vector3::z(), symmetry_axis(0.4, angle));
        let rigid = anisotropic_potential_of_axis(1.0, &s, &axis);
        (angle, (rigid - nordtvedt_potential(1.0, 2.0, &w, &angular_velocity)).abs())
    });
    // Rounding: 1e-16 of C.
    measured_order(&points, 1e-15)
}

struct PotentialInAngles;

impl Identity for PotentialInAngles {
    const ID: &'static str = "potential-in-angles";
    const ROUNDED: (Kind, &'static str) = (Kind::Property, "potential-in-angles-rounding");
    const EQUATIONS: &'static [u8] = &[7, 11, 21];
    const STATEMENT: &'static str = "the potential in Euler angles is C s^zz of the rotated tensor, and C n.(s n)";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let c = p.spheroid.constant_c;
        let rotation = body_from_inertial(&p.angles);
        let body = tensor_in_body_frame(&rotation, &p.s.tensor());
        let in_angles = anisotropic_potential_in_angles(c, &p.s, p.angles.alpha, p.angles.beta);
        vec![
            in_angles - anisotropic_potential(c, body[(2, 2)]),
            in_angles - anisotropic_potential_of_axis(c, &p.s.tensor(), &rotation.row(2).transpose()),
        ]
    }
}

struct PotentialGradient;

impl Identity for PotentialGradient {
    const ID: &'static str = "potential-gradient";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "potential-gradient-autodiff");
    const EQUATIONS: &'static [u8] = &[21];
    const STATEMENT: &'static str = "the gradient kernel is the derivative of the potential by alpha and by beta";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let q = &p.angles;
        let (by_alpha, by_beta) = potential_gradient_in_angles(p.spheroid.constant_c, &p.s, q.alpha, q.beta);
        let c = F::fixed(p.spheroid.constant_c);
        let s = PrincipalCoefficients::new([p.s.xx, p.s.yy, p.s.zz].map(F::fixed));
        let along = |alpha_rate, beta_rate| {
            let (alpha, beta) = (F::first(q.alpha, alpha_rate), F::first(q.beta, beta_rate));
            F::derivative(anisotropic_potential_in_angles(c, &s, alpha, beta))
        };
        vec![by_alpha - along(F::one(), F::zero()), by_beta - along(F::zero(), F::one())]
    }
}

struct PotentialOfBody;

impl Identity for PotentialOfBody {
    const ID: &'static str = "potential-of-body";
    const ROUNDED: (Kind, &'static str) = (Kind::Property, "potential-of-body-rounding");
    const EQUATIONS: &'static [u8] = &[6, 11, 12, 17];
    const STATEMENT: &'static str =
        "-(1/2) s^ij U^ij of a spheroid is C s^zz - (1/2) U^xx tr s with C = (U^xx - U^zz) / 2";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let (xx, zz) = (p.numbers[0], p.numbers[1]);
        let c = (xx - zz) / 2.0;
        let body = tensor_in_body_frame(&body_from_inertial(&p.angles), &p.s_inertial);
        let tensor = Matrix3::from_diagonal(&Vector3::new(xx, xx, zz));
        vec![
            anisotropic_potential_of_body(&body, &tensor) + xx * p.s_inertial.trace() / 2.0
                - anisotropic_potential(c, body[(2, 2)]),
        ]
    }
}

struct KineticEnergy;

impl Identity for KineticEnergy {
    const ID: &'static str = "kinetic-energy";
    const ROUNDED: (Kind, &'static str) = (Kind::Property, "kinetic-energy-rounding");
    const EQUATIONS: &'static [u8] = &[22, 23];
    const STATEMENT: &'static str = "the kinetic energy in Euler rates is (1/2) I^ij Omega^i Omega^j of the body rates";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let of_body = kinetic_energy_of_body(&p.spheroid.inertia(), &body_rates(&p.angles, &p.rates));
        vec![kinetic_energy(&p.spheroid, p.angles.beta, &p.rates) - of_body]
    }
}

struct NordtvedtForm;

impl Identity for NordtvedtForm {
    const ID: &'static str = "nordtvedt-form";
    const ROUNDED: (Kind, &'static str) = (Kind::Property, "nordtvedt-form-rounding");
    const EQUATIONS: &'static [u8] = &[5, 11, 13];
    const STATEMENT: &'static str =
        "with s^ij = -alpha_2 w^i w^j and C = T_rot / 2 the potential of a star spinning about its axis is Nordtvedt's";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let (alpha_2, rotational_energy) = (p.numbers[0], p.spheroid.constant_c);
        let axis = symmetry_axis(p.angles.alpha, p.angles.beta);
        let s = coefficients_from_preferred_frame(alpha_2, &p.gradient);
        vec![
            anisotropic_potential_of_axis(rotational_energy / 2.0, &s, &axis)
                - nordtvedt_potential(alpha_2, rotational_energy, &p.gradient, &axis),
        ]
    }
}
