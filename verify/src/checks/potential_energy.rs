//! Potential and kinetic energy in Euler angles from their coordinate-free forms. Eqs. (5)-(7), (11), (13),
//! (21)-(23).

use crate::prelude::*;

checks! {
    /// the potential in Euler angles is C s^zz of the rotated tensor, and C n.(s n)
    potential_in_angles: Property "potential-in-angles" [7, 11, 21];
    /// the gradient kernel is the derivative of the potential by alpha and by beta
    potential_gradient: Autodiff "potential-gradient" [21];
    /// -(1/2) s^ij U^ij of a spheroid is C s^zz - (1/2) U^xx tr s with C = (U^xx - U^zz) / 2
    potential_of_body: Property "potential-of-body" [6, 11, 12, 17];
    /// with s^ij = -alpha_2 w^i w^j and C = T_rot / 2 the potential of a star spinning about its axis is Nordtvedt's
    nordtvedt_form: Property "nordtvedt-form" [5, 11, 13];
    /// the kinetic energy in Euler rates is (1/2) I^ij Omega^i Omega^j of the body rates
    kinetic_energy_in_rates: Property "kinetic-energy" [22, 23];
    /// Nordtvedt's form differs from delta U = C s^zz to first order in the angle between angular velocity and axis
    Regime "nordtvedt-form-needs-alignment" [11, 13]: misaligned_nordtvedt;
    Within(0.95, 1.05) "slope of log(difference / C) against log of that angle, 1e-1 to 1e-5 rad";
    because "one form contains the direction of the angular velocity, the other the axis; an integer order to 0.05";
}

/// Both forms for a star that rotates about a direction at an angle to its axis, with `w` at 0.6 rad from the axis.
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

fn potential_in_angles<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let c = p.spheroid.constant_c;
    let rotation = body_from_inertial(&p.angles);
    let body = tensor_in_body_frame(&rotation, &p.s.tensor());
    let in_angles = anisotropic_potential_in_angles(c, &p.s, p.angles.alpha, p.angles.beta);
    vec![
        in_angles - anisotropic_potential_of_axis(c, &body, &Vector3::z()),
        in_angles - anisotropic_potential_of_axis(c, &p.s.tensor(), &rotation.row(2).transpose()),
    ]
}

fn potential_gradient<F: Differentiable>(p: &Point<F>) -> Vec<F> {
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

fn potential_of_body<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (xx, zz) = (p.numbers[0], p.numbers[1]);
    let c = (xx - zz) / 2.0;
    let body = tensor_in_body_frame(&body_from_inertial(&p.angles), &p.s_inertial);
    let tensor = Matrix3::from_diagonal(&Vector3::new(xx, xx, zz));
    vec![
        anisotropic_potential_of_body(&body, &tensor) + xx * p.s_inertial.trace() / 2.0
            - anisotropic_potential_of_axis(c, &body, &Vector3::z()),
    ]
}

fn kinetic_energy_in_rates<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let of_body = kinetic_energy_of_body(&p.spheroid.inertia(), &body_rates(&p.angles, &p.rates));
    vec![kinetic_energy(&p.spheroid, p.angles.beta, &p.rates) - of_body]
}

fn nordtvedt_form<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (alpha_2, rotational_energy) = (p.numbers[0], p.spheroid.constant_c);
    let axis = symmetry_axis(p.angles.alpha, p.angles.beta);
    let s = coefficients_from_preferred_frame(alpha_2, &p.gradient);
    vec![
        anisotropic_potential_of_axis(rotational_energy / 2.0, &s, &axis)
            - nordtvedt_potential(alpha_2, rotational_energy, &p.gradient, &axis),
    ]
}
