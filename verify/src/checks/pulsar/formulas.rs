//! Angles of the magnetic axis, periods and widths with roots and inverse functions. Eqs. (49)-(51), (53)-(56).

use twofold::observables::pulsar::width::edge_azimuths;

use super::identities::spherical;
use crate::prelude::*;

checks! {
    /// Theta and Phi, the latter by the two-argument arc tangent, are the colatitude and azimuth of the turned axis in every quadrant
    Property "magnetic-axis-angles" [45, 49, 50]: angles_of_axis;
    AtMost(8.0) "largest error of a component / 2.2e-16, 2,000 random orientations";
    because "Phi up to 2 pi is rounded by half an ulp, 2 x 2.2e-16, twice, and so is the axis it is compared with";
    /// the approximate period of Eq. (51) is the exact one times 1 - (DeltaPhi' / alpha')^2: its error is of second order
    Property "pulse-period-first-order" [51]: second_order_of_period;
    AtMost(4.0) "largest relative error / 2.2e-16, 2,000 random rates";
    because "four roundings of half an ulp on either side";
    /// at the azimuths (55) the product (54) is cos rho, inside them it is above and outside below; without edges the axis is always or never
    /// within rho of the line of sight
    Property "pulse-width-edges" [44, 53, 54, 55, 56]: edges_of_width;
    AtMost(16.0) "largest error of cos rho or of cos(W/2) sin Theta sin theta_o / 2.2e-16, 20,000 random cases; infinite for a wrong kind";
    because "azimuths up to pi + phi_o are rounded by 2 x 2.2e-16 twice; the arguments of four half sines, the quotient and the arc tangent add as \
     much";
    /// for Theta = theta_o the width is 4 arcsin(sin(rho/2) / sin Theta), down to beams of 1e-12 rad
    Property "narrow-pulse-width" [56]: narrow_widths;
    AtMost(8.0) "largest relative error / 2.2e-16, rho = 1e-12 to 0.1, Theta = 0.2 to 2.9";
    because "some ten roundings of half an ulp; the printed cosine would lose all digits below rho = 1e-8";
}

fn angles_of_axis() -> Result<Measured, String> {
    worst_of_draws(49, 2000, |random| {
        let q =
            EulerAngles { alpha: random.within(-PI, PI), beta: random.within(0.0, PI), gamma: random.within(-PI, PI) };
        let (chi, delta) = (random.within(0.0, PI), random.within(-PI, PI));
        let (theta, phi) = magnetic_axis_direction(&q, chi, delta)?;
        let m = body_from_inertial(&q).transpose() * Beam::new(chi, delta, 1.0).axis;
        let error = largest_component(&(spherical(theta, phi) - m));
        let cosine = (cosine_of_colatitude(q.beta, q.gamma, chi, delta) - theta.cos()).abs();
        Ok(largest([error, cosine]) / f64::EPSILON)
    })
}

fn second_order_of_period() -> Result<Measured, String> {
    worst_of_draws(51, 2000, |random| {
        let alpha: f64 = random.within(0.5, 2.0);
        let offset = alpha * random.within(-0.5, 0.5);
        let exact = instantaneous_period(alpha + offset);
        let expected = exact * (1.0 - (offset / alpha).powi(2));
        let error = (approximate_period(alpha, offset) / expected - 1.0).abs();
        let one_turn = (exact * (alpha + offset) / TAU - 1.0).abs();
        Ok(largest([error, one_turn]) / f64::EPSILON)
    })
}

fn edges_of_width() -> Result<Measured, String> {
    let mut kinds = [0; 3];
    let measured = worst_of_draws(56, 20_000, |random| {
        let [rho, theta, theta_o] = [0; 3].map(|_| random.within(0.0, PI));
        let phi_o = random.within(-PI, PI);
        let product = |phi: f64| axis_along_line_of_sight_in_azimuth(theta, phi, theta_o, phi_o);
        let (nearest, farthest) = (product(phi_o) - rho.cos(), product(phi_o + PI) - rho.cos());
        Ok(match pulse_width(rho, theta, theta_o) {
            PulseWidth::Pulsed(width) => {
                kinds[0] += 1;
                let (first, second) = edge_azimuths(phi_o, width);
                let at_edges = largest([first, second].map(|phi| (product(phi) - rho.cos()).abs()));
                let printed =
                    (cosine_of_half_width(rho, theta, theta_o) - (width / 2.0).cos()) * theta.sin() * theta_o.sin();
                // The width is the difference of the azimuths of its edges, Eq. (53).
                let difference = (second - first - width).abs() / 4.0;
                let right_kind = 0.0 < width && width < TAU && nearest > -1e-15 && farthest < 1e-15;
                if right_kind { largest([at_edges, printed.abs(), difference]) / f64::EPSILON } else { f64::INFINITY }
            }
            PulseWidth::AlwaysOn => {
                kinds[1] += 1;
                if farthest > -1e-15 { 0.0 } else { f64::INFINITY }
            }
            PulseWidth::NeverOn => {
                kinds[2] += 1;
                if nearest < 1e-15 { 0.0 } else { f64::INFINITY }
            }
        })
    })?;
    if kinds.contains(&0) {
        return Err(format!("a kind was never met: {kinds:?}"));
    }
    Ok(measured)
}

fn narrow_widths() -> Result<Measured, String> {
    let inclinations = |decade: i32| (0..28).map(move |i| (10f64.powi(-decade), 0.2 + 0.1 * f64::from(i)));
    worst_of((1..=12).flat_map(inclinations), |&(rho, theta)| {
        let PulseWidth::Pulsed(width) = pulse_width(rho, theta, theta) else {
            return Err(format!("no pulse at rho = {rho}, Theta = theta_o = {theta}"));
        };
        let expected = 4.0 * ((rho / 2.0).sin() / theta.sin()).asin();
        Ok((width / expected - 1.0).abs() / f64::EPSILON)
    })
}
