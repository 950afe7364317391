//! Precession about the middle principal axis of `s^IJ` is unstable.

use crate::prelude::*;
use twofold::numerics::straight_line::slope;

checks! {
    /// forced precession about the middle axis of s^IJ (X, Y, Z in turn) is unstable with the rate (2 C |P2| / G) sqrt((s1 - s2)(s2 - s3))
    Regime "middle-axis-growth" [36]: growth_about_middle_axis;
    AtMost(0.02) "largest |growth rate / formula - 1|, s of the examples scaled by 0.02, permuted, about X, Y, Z";
    because "the formula is of first order: relative error of the order of s = 8e-4, and the fit's window adds a percent";
    /// forced precession about the axes of the largest and the smallest eigenvalue (X, Y, Z in turn) is stable
    Regime "outer-axes-stable" [36]: tilt_about_outer_axes;
    AtMost(10.0) "largest tilt of L over twenty growth times of the middle axis / initial tilt";
    because "bounded by the axis ratio of the ellipse about the stable axis, at most sqrt(6) here, and the fast wobble of L";
}

const SCALE: f64 = 0.02;
const MOMENTUM: f64 = 1.1;
const START: f64 = 1e-7;

/// Arrangements of the examples' eigenvalues with the given one on the axis about which L precesses, and that axis.
fn arrangements(on_axis: f64, others: [f64; 2]) -> Vec<(usize, PrincipalCoefficients<f64>)> {
    (0..3)
        .map(|axis| {
            let mut s = [0.0; 3];
            s[axis] = on_axis;
            s[(axis + 1) % 3] = others[0];
            s[(axis + 2) % 3] = others[1];
            (axis, PrincipalCoefficients::new(s).scaled(SCALE))
        })
        .collect()
}

/// Tilts of L from a coordinate axis at times up to `duration`, for a star that starts spinning about L.
fn tilts(axis: usize, s: &PrincipalCoefficients<f64>, duration: f64) -> Result<Vec<(f64, f64)>, String> {
    let mut l = Vector3::zeros();
    l[axis] = 1.0;
    l[(axis + 1) % 3] = START;
    l[(axis + 2) % 3] = START * 0.7;
    let l = l.normalize();
    let initial = AxisState { axis: l, momentum: l * MOMENTUM };
    let spheroid = RigidSpheroid::in_units_of_tc(1.1);
    let motion = Problem::new(spheroid, s.tensor(), initial)?.taylor((0.0, duration), 1e-12)?;
    let samples = 4000;
    (0..=samples)
        .map(|i| {
            let t = duration * f64::from(i) / f64::from(samples);
            let momentum = motion.state(t)?.momentum;
            let across = (0..3).filter(|&k| k != axis).map(|k| momentum[k].powi(2)).sum::<f64>().sqrt();
            Ok((t, across / momentum.norm()))
        })
        .collect()
}

/// First-order growth rate for a star spinning about L: `P2(1) = 1`.
fn growth_rate() -> f64 {
    2.0 / MOMENTUM * SCALE * f64::sqrt((0.02 - 0.01) * (0.01 + 0.04))
}

fn growth_about_middle_axis() -> Result<Measured, String> {
    worst_of(arrangements(0.01, [0.02, -0.04]), |(axis, s)| {
        // The decaying part must have died out, and the tilt must still be small.
        let window: Vec<_> = tilts(*axis, s, 14.0 / growth_rate())?
            .into_iter()
            .filter(|(t, tilt)| t * growth_rate() > 3.0 && *tilt < 0.03)
            .map(|(t, tilt)| (t, tilt.ln()))
            .collect();
        Ok((slope(&window)?.value / growth_rate() - 1.0).abs())
    })
}

fn tilt_about_outer_axes() -> Result<Measured, String> {
    let about_first = arrangements(0.02, [0.01, -0.04]);
    worst_of(about_first.into_iter().chain(arrangements(-0.04, [0.02, 0.01])), |(axis, s)| {
        let tilts = tilts(*axis, s, 20.0 / growth_rate())?;
        worst_of(&tilts, |(_, tilt)| Ok(tilt / tilts[0].1))
    })
}
