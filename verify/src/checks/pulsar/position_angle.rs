//! Position angle of the polarization: the rotating-vector model of a precessing star. Eqs. (45), (46), (49), (70).

use twofold::observables::pulsar::position_angle::{
    position_angle, position_angle_rate, rotating_vector_gradient, rotating_vector_point,
    rotating_vector_position_angle, sky_from_inertial,
};

use super::cases;
use super::identities::spherical;
use crate::prelude::*;

checks! {
    /// north on the sky is the projection of Z, east is along Z x (direction in which the observer looks), as right ascension increases, and
    /// north x east points to the observer, who sees the angle from north to east as counterclockwise
    sky_directions: Property "sky-directions" [46, 70];
    /// the point at the position angle is the projection of m on the sky, as a vector and in (Theta, Phi), and its tangent is minus the one printed
    /// by Radhakrishnan and Cooke (1969)
    rotating_vector_model: Property "rotating-vector-model" [45, 46, 49, 70];
    /// the derivatives of the position angle by Theta and Phi are those of the point by duals, and the steepest one, at Phi = phi_o, is -sin Theta
    /// / sin(theta_o - Theta)
    gradient: Autodiff "rotating-vector-gradient" [49, 70];
    /// the rate of the position angle is that of the projection of m along any motion by duals, and the gradient of the rotating-vector model times
    /// the rates of Theta and Phi
    rate_of_position_angle: Autodiff "position-angle-rate" [22, 45, 49, 70];
    /// along the numerical motion of a star that spins about Z the position angle is minus the angle of Radhakrishnan and Cooke (1969), tan = sin
    /// chi sin(Phi - phi_o) / (sin zeta cos chi - cos zeta sin chi cos(Phi - phi_o)), its half turn included
    Oracle "position-angle-of-upright-star" [45, 46, 70]: upright_star;
    AtMost(4.0) "largest error / (2.2e-16 (4 + phase / |m x n|)), 200 stars at 40 times";
    because "the phase of the motion and that of the formula are rounded by an ulp; near the line of sight it is divided by |m x n|";
    /// from the state and from Theta, Phi of Eq. (49) the position angle is the same, in every quadrant; along the line of sight both return an error
    Property "position-angle-of-precessing-star" [45, 49, 70]: state_and_angles;
    AtMost(16.0) "largest difference x |m x n| / 2.2e-16, 2,000 random orientations";
    because "some ten roundings of unit vectors, azimuths up to 2 pi rounded by 2 x 2.2e-16";
}

/// The angles `chi`, `delta`, and the observer's `theta_o`, `phi_o` from a point.
fn angles<F: Scalar>(p: &Point<F>) -> [F; 4] {
    [p.numbers[0], p.numbers[1], p.frame.beta, p.frame.alpha]
}

fn sky_directions<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let [.., theta_o, phi_o] = angles(p);
    let observer = Observer::at(theta_o, phi_o);
    let sky = sky_from_inertial(&observer);
    let [north, east, towards] = [0, 1, 2].map(|row| sky.row(row).transpose());
    let (sin, _) = theta_o.sin_cos();
    // The observer looks along -n; right ascension increases eastwards, in the sense of a rotation about Z.
    let (z, view) = (Vector3::z(), -observer.direction);
    components![
        sky * sky.transpose() - Matrix3::identity(),
        north * sin - (z - view * view.dot(&z)),
        east * sin - z.cross(&view),
        north.cross(&east) - towards,
        towards + view,
    ]
}

fn rotating_vector_model<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let [theta, phi, theta_o, phi_o] = angles(p);
    let m = spherical(theta, phi);
    let on_sky = sky_from_inertial(&Observer::at(theta_o, phi_o)) * m;
    let (north, east) = rotating_vector_point(theta, phi, theta_o, phi_o);
    let ((s, c), (s_o, c_o)) = (theta.sin_cos(), theta_o.sin_cos());
    let ((sp, cp), (sp_o, cp_o)) = (phi.sin_cos(), phi_o.sin_cos());
    let (sin, cos) = (sp * cp_o - cp * sp_o, cp * cp_o + sp * sp_o);
    let across = m.cross(&spherical(theta_o, phi_o));
    vec![
        north - on_sky.x,
        east - on_sky.y,
        north * north + east * east - across.dot(&across),
        east * (s_o * c - c_o * s * cos) + north * (s * sin),
    ]
}

fn gradient<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let [theta, phi, theta_o, phi_o] = angles(p);
    let (by_theta, by_phi) = rotating_vector_gradient(theta, phi, theta_o, phi_o);
    let swept = |theta, phi| {
        let moving = rotating_vector_point::<F::First>(theta, phi, F::fixed(theta_o), F::fixed(phi_o));
        let (north, east) = (F::value(moving.0), F::value(moving.1));
        (north * F::derivative(moving.1) - east * F::derivative(moving.0), north * north + east * east)
    };
    let (along_theta, squared) = swept(F::first(theta, F::one()), F::fixed(phi));
    let (along_phi, _) = swept(F::fixed(theta), F::first(phi, F::one()));
    let (_, steepest) = rotating_vector_gradient(theta, phi_o, theta_o, phi_o);
    let ((s, c), (s_o, c_o)) = (theta.sin_cos(), theta_o.sin_cos());
    vec![by_theta * squared - along_theta, by_phi * squared - along_phi, steepest * (s_o * c - c_o * s) + s]
}

fn rate_of_position_angle<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let [chi, delta, theta_o, phi_o] = angles(p);
    let observer = Observer::at(theta_o, phi_o);
    let (q, v) = (&p.angles, &p.rates);
    let rotation = body_from_inertial(q).transpose();
    let in_body = spherical(chi, delta);
    let m = rotation * in_body;
    let rate = position_angle_rate(&m, &(rotation * body_rates(q, v)), &observer);
    let moving = body_from_inertial(&moving_angles(q, v)).transpose() * in_body.map(F::fixed);
    let m_rate = moving.map(F::derivative);
    let sky = sky_from_inertial(&observer);
    let (here, there) = (sky * m, sky * m_rate);
    // An arbitrary axis at (theta, phi) with arbitrary rates of both.
    let (theta, phi, theta_rate, phi_rate) = (p.numbers[2], p.numbers[3], p.accelerations.alpha, p.accelerations.beta);
    let (by_theta, by_phi) = rotating_vector_gradient(theta, phi, theta_o, phi_o);
    let axis = spherical::<F::First>(F::first(theta, theta_rate), F::first(phi, phi_rate));
    let (axis, axis_rate) = (axis.map(F::value), axis.map(F::derivative));
    // Angular velocity for this axis rate.
    let omega = axis.cross(&axis_rate);
    vec![
        rate * (here.x * here.x + here.y * here.y) - (here.x * there.y - here.y * there.x),
        position_angle_rate(&axis, &omega, &observer) - by_theta * theta_rate - by_phi * phi_rate,
    ]
}

fn upright_star() -> Result<Measured, String> {
    worst_of_draws(69, 200, |random| {
        let [chi, zeta] = [0; 2].map(|_| random.within(0.05, 3.09));
        let (delta, phi_o, spin) = (random.within(-3.0, 3.0), random.within(-3.0, 3.0), random.within(-2.0, 2.0));
        let motion = cases::upright_star(random.within(0.5, 1.8), spin)?.taylor((0.0, 20.0), 1e-15)?;
        let (beam, observer) = (Beam::new(chi, delta, 0.5), Observer::at(zeta, phi_o));
        worst_of((0..40).map(|i| 0.5 * f64::from(i)), |&t| {
            let state = motion.state(t)?;
            let m = beam.direction(&state);
            let psi = position_angle(&m, &observer)?;
            let phi = spin * t + delta - phi_o;
            let across = m.cross(&observer.direction).norm();
            let (down, along) = (chi.sin() * phi.sin(), zeta.sin() * chi.cos() - zeta.cos() * chi.sin() * phi.cos());
            let printed = down.atan2(along);
            let omega = angular_velocity(motion.spheroid(), &state.axis, &state.momentum);
            let rate = position_angle_rate(&m, &omega, &observer);
            let gradient = rotating_vector_gradient(chi, spin * t + delta, zeta, phi_o).1 * spin;
            let scale = f64::EPSILON * (4.0 + (4.0 + phi.abs()) / across);
            let errors = [wrapped(psi + printed).abs(), (rate - gradient).abs() * across / (4.0 * spin.abs().max(0.1))];
            Ok(largest(errors) / scale)
        })
    })
}

fn state_and_angles() -> Result<Measured, String> {
    worst_of_draws(70, 2000, |random| {
        let [alpha, gamma, delta, phi_o] = [0; 4].map(|_| random.within(-3.1, 3.1));
        let [beta, chi, theta_o] = [0; 3].map(|_| random.within(0.05, 3.09));
        let q = EulerAngles { alpha, beta, gamma };
        let (theta, phi) = magnetic_axis_direction(&q, chi, delta)?;
        let observer = Observer::at(theta_o, phi_o);
        let m = body_from_inertial(&q).transpose() * Beam::new(chi, delta, 0.5).axis;
        let by_angles = rotating_vector_position_angle(theta, phi, theta_o, phi_o)?;
        let difference = wrapped(position_angle(&m, &observer)? - by_angles).abs();
        let across = m.cross(&observer.direction).norm();
        let refused = position_angle(&observer.direction, &observer).is_err()
            && rotating_vector_position_angle(theta_o, phi_o, theta_o, phi_o).is_err();
        Ok(if refused { difference * across / f64::EPSILON } else { f64::INFINITY })
    })
}
