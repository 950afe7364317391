//! Direction of the magnetic axis and its rate, as identities of rational functions. Eqs. (45), (47), (49)-(52), (54).

use crate::prelude::*;

checks! {
    /// Eq. (47) is the component of the magnetic axis (45), rotated by Eq. (9), along the line of sight; the margin of the beam adds -cos rho, the
    /// second beam has the opposite sign; Eq. (54) is the product of two unit vectors
    beam_along_line_of_sight: Property "axis-along-line-of-sight" [9, 44, 45, 47, 54];
    /// cos Theta is m_Z, the point at the angle alpha + DeltaPhi is (m_X, m_Y), and its tangent is that of Eq. (50) as printed
    direction_of_magnetic_axis: Property "direction-of-magnetic-axis" [45, 49, 50];
    /// Eq. (52), in the regular form and as printed, is the time derivative of the angle (50) at constant beta
    offset_rate_of_azimuth: Autodiff "azimuth-offset-rate" [50, 52];
    /// the exact rate of the azimuth is that of (m_X, m_Y) along any motion, and alpha' + DeltaPhi' of Eq. (52) where beta is constant
    magnetic_azimuth_rate: Autodiff "magnetic-azimuth-rate" [49, 51, 52];
}

/// The angles `chi`, `delta` of the magnetic axis and the observer's `theta_o`, `phi_o` from a point.
fn four_angles<F: Scalar>(p: &Point<F>) -> [F; 4] {
    [p.frame.beta, p.frame.gamma, p.frame.alpha, p.numbers[0]]
}

/// The unit vector at a colatitude and an azimuth.
pub(super) fn spherical<F: Scalar>(colatitude: F, azimuth: F) -> Vector3<F> {
    let ((s, c), (s_azimuth, c_azimuth)) = (colatitude.sin_cos(), azimuth.sin_cos());
    Vector3::new(s * c_azimuth, s * s_azimuth, c)
}

fn beam_along_line_of_sight<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let ([chi, delta, theta_o, phi_o], rho) = (four_angles(p), p.numbers[1]);
    let (beam, state) = (Beam::new(chi, delta, rho), BodyState::from_angles(&p.spheroid, &p.angles, &p.rates));
    let observer = spherical(theta_o, phi_o);
    let in_angles = axis_along_line_of_sight(&p.angles, chi, delta, theta_o, phi_o);
    let turned = body_from_inertial(&p.angles).transpose() * spherical(chi, delta);
    let (theta, phi) = (p.numbers[2], p.numbers[3]);
    let in_azimuth = axis_along_line_of_sight_in_azimuth(theta, phi, theta_o, phi_o);
    vec![
        in_angles - turned.dot(&observer),
        in_angles - beam.direction(&state).dot(&observer),
        in_angles - rho.sin_cos().1 - beam.margin(&state, &observer),
        in_angles + rho.sin_cos().1 + beam.opposite().margin(&state, &observer),
        in_azimuth - spherical(theta, phi).dot(&observer),
    ]
}

fn direction_of_magnetic_axis<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let [chi, delta, ..] = four_angles(p);
    let (q, rotation) = (&p.angles, body_from_inertial(&p.angles));
    let m = rotation.transpose() * spherical(chi, delta);
    let (x, y) = azimuth_offset_point(q.beta, q.gamma, chi, delta);
    let ((sa, ca), (sb, cb), (s_chi, c_chi)) = (q.alpha.sin_cos(), q.beta.sin_cos(), chi.sin_cos());
    let ((sg, cg), (sd, cd)) = (q.gamma.sin_cos(), delta.sin_cos());
    let (sin, cos) = (sg * cd + cg * sd, cg * cd - sg * sd);
    vec![
        cosine_of_colatitude(q.beta, q.gamma, chi, delta) - m.z,
        ca * x - sa * y - m.x,
        sa * x + ca * y - m.y,
        y * cos - x * (cb * sin - sb * (c_chi / s_chi)),
    ]
}

fn offset_rate_of_azimuth<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let [chi, delta, ..] = four_angles(p);
    let (beta, gamma, gamma_rate) = (p.angles.beta, p.angles.gamma, p.rates.gamma);
    let rate = azimuth_offset_rate(beta, gamma, gamma_rate, chi, delta);
    let moving = azimuth_offset_point(F::fixed(beta), F::first(gamma, gamma_rate), F::fixed(chi), F::fixed(delta));
    let (x, y) = (F::value(moving.0), F::value(moving.1));
    let swept = x * F::derivative(moving.1) - y * F::derivative(moving.0);
    let ((sb, cb), (s_chi, c_chi)) = (beta.sin_cos(), chi.sin_cos());
    let ((sg, cg), (sd, cd)) = (gamma.sin_cos(), delta.sin_cos());
    let (sin, cos) = (sg * cd + cg * sd, cg * cd - sg * sd);
    let cot = c_chi / s_chi;
    let across = sb * cot - cb * sin;
    vec![rate * (x * x + y * y) - swept, rate * (cos * cos + across * across) + gamma_rate * (sb * cot * sin - cb)]
}

fn magnetic_azimuth_rate<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let [chi, delta, ..] = four_angles(p);
    let (q, v) = (&p.angles, &p.rates);
    let rotation = body_from_inertial(q).transpose();
    let in_body = spherical(chi, delta);
    let m = rotation * in_body;
    let moving = body_from_inertial(&moving_angles(q, v)).transpose() * in_body.map(F::fixed);
    let rate = azimuth_rate(&m, &(rotation * body_rates(q, v)));
    let swept = m.x * F::derivative(moving.y) - m.y * F::derivative(moving.x);
    let mut level = *v;
    level.beta = F::zero();
    let at_constant_beta = azimuth_rate(&m, &(rotation * body_rates(q, &level)));
    vec![
        rate * (m.x * m.x + m.y * m.y) - swept,
        at_constant_beta - v.alpha - azimuth_offset_rate(q.beta, q.gamma, v.gamma, chi, delta),
    ]
}
