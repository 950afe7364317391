//! The unstable motion about the middle axis, and slow periods near the separatrix.

use twofold::solutions::averaged::period_near_separatrix;
use twofold::solutions::torus::{TorusSolution, separatrix_motion};

use super::scenes::Scene;
use crate::prelude::*;

checks! {
    /// the growth rate at the middle axis is that of the monodromy matrix of the unstable periodic motion, to first and second order; for a spin
    /// along the axis, that of a closed quartic
    Regime "middle-axis-growth-orders" [36]: growth_orders;
    AtMost(0.15) "largest |measured slope of the relative error - order|, s of the examples scaled by 1 to 0.03, n turning about L at 0, 0.4 and 1.1 \
     rad";
    because "corrections of relative order 0.06";
    /// with the examples' s the second-order growth rate is right to half a percent
    Regime "middle-axis-growth-exact" [36]: growth_of_examples;
    AtMost(0.005) "largest relative error, n turning about L at 0, 0.4 and 1.1 rad";
    because "second order in a strength of 0.03 to 0.05, as for the slow frequency";
    /// towards the separatrix the exact slow period grows by (2 / mu) ln 10 per tenth of the distance in K, with the exact mu
    Regime "separatrix-period-logarithm" [36]: separatrix_logarithm;
    AtMost(1e-3) "largest relative difference, both sides, from k'^2 = 1e-3 to 1e-6";
    because "the next term is k'^2 ln k' / 2, over 2.3";
    /// the slow period near the separatrix is (4 / mu) ln(4 / k') with mu of second order and k' from K
    Regime "separatrix-period-formula" [36]: separatrix_formula;
    AtMost(1.0) "largest relative difference / strength of the torque, both sides, k'^2 from 1e-2 to 1e-6, s of the examples scaled by 1, 0.3, 0.1";
    because "k' is of first order in the strength, as the logarithm's constant";
}

/// A star whose axis circles `L` at the angle `nutation`, with `L` along the middle axis of the examples' s scaled by `k`: the unstable periodic
/// motion and its exact growth rate.
fn unstable(k: f64, nutation: f64) -> Result<(Scene, f64), String> {
    let body = RigidSpheroid { inertia_xx: 0.8, inertia_zz: 0.88, constant_c: 1.3 };
    let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]).scaled(k);
    let g = 1.4;
    if nutation == 0.0 {
        let start = BodyState { axis: Vector3::y(), momentum: Vector3::y() * g, equatorial_axis: Vector3::x() };
        // (l^2 + p)(l^2 - q) + (g / I^xx)^2 l^2 = 0.
        let [p, q] = [s.xx - s.yy, s.yy - s.zz].map(|gap| 2.0 * body.constant_c * gap / body.inertia_xx);
        let b = (g / body.inertia_xx).powi(2) + p - q;
        // Without cancellation.
        let square = 2.0 * p * q / (b + (b * b + 4.0 * p * q).sqrt());
        return Ok((Scene { body, s, start }, square.sqrt()));
    }
    let spin = g * f64::cos(nutation) / body.inertia_zz;
    let energy = (g * f64::sin(nutation)).powi(2) / (2.0 * body.inertia_xx) + body.inertia_zz * spin * spin / 2.0;
    let start = separatrix_motion(&body, &s, energy, spin)?;
    let scene = Scene { body, s, start };
    // The period: n and L lie in the same plane again, twice per turn.
    let problem = scene.problem()?;
    let motion = problem.taylor((0.0, 10.0), 1e-16)?;
    let out = |t: f64| motion.state(t).map(|state| state.axis.z).map_err(String::from);
    let turn = TAU * body.inertia_xx / g;
    let (mut left, mut right) = (0.9 * turn, 1.1 * turn);
    let sign = out(left)?;
    if sign * out(right)? >= 0.0 {
        return Err("n does not come back to the plane after a turn".into());
    }
    for _ in 0..60 {
        let middle = 0.5 * (left + right);
        if out(middle)? * sign > 0.0 { left = middle } else { right = middle }
    }
    let period = 0.5 * (left + right);
    let back = motion.state(period)?;
    let off = largest([(back.axis - start.axis).norm(), (back.momentum - start.momentum).norm()]);
    if off.is_nan() || off > 1e-9 {
        return Err(format!("the motion about the middle axis is not periodic: {off:e}"));
    }
    // Trace of the monodromy matrix of (n, L). Four of its eigenvalues are one, the other two exp(+-mu T).
    let lifted: Problem<Dual64, AxisState<Dual64>> = problem.reduced().map(Dual64::from_re);
    let mut excess = -6.0;
    for place in 0..6 {
        let mut vectors = [lifted.initial().axis, lifted.initial().momentum];
        vectors[place / 3][place % 3].eps = 1.0;
        let [axis, momentum] = vectors;
        let end = lifted.starting_from(AxisState { axis, momentum })?.taylor((0.0, period), 1e-16)?;
        let end = end.state(Dual64::from_re(period))?;
        excess += [end.axis, end.momentum][place / 3][place % 3].eps;
    }
    // 2 cosh(mu T) - 2 = 4 sinh^2(mu T / 2).
    Ok((scene, 2.0 * (excess.max(0.0).sqrt() / 2.0).asinh() / period))
}

fn growth_error(order: AveragingOrder, k: f64, nutation: f64) -> Result<f64, String> {
    let (scene, exact) = unstable(k, nutation)?;
    let FirstIntegrals { energy, spin, .. } = scene.integrals();
    let formula = middle_axis_growth(&scene.body, &scene.s, energy, spin, order)?;
    Ok((formula / exact - 1.0).abs())
}

const NUTATIONS: [f64; 3] = [0.0, 0.4, 1.1];

fn growth_orders() -> Result<Measured, String> {
    let mut errors = Vec::new();
    for nutation in NUTATIONS {
        for (order, expected) in [(AveragingOrder::First, 1.0), (AveragingOrder::Second, 2.0)] {
            let points = errors_at([0.3, 0.1, 0.03], |k| growth_error(order, k, nutation))?;
            errors.push((format!("{order:?}, {nutation}"), expected, points));
        }
    }
    largest_off_order(errors)
}

fn growth_of_examples() -> Result<Measured, String> {
    worst_of(NUTATIONS, |&nutation| growth_error(AveragingOrder::Second, 1.0, nutation))
}

/// Exact slow period at the signed distance `k'^2` from the separatrix of the examples' s scaled by `k`, with the growth rate and the scene.
fn near_separatrix(k: f64, complement: f64) -> Result<(f64, f64, Scene), String> {
    let (scene, growth) = unstable(k, 0.7)?;
    let mut integrals = scene.integrals();
    let PrincipalCoefficients { xx: s1, yy: s2, zz: s3 } = scene.s;
    integrals.clebsch += complement * (s1 - s2) * (s2 - s3) / (s1 - s3) * scene.start.momentum.norm_squared();
    let found = states_with_integrals(&scene.body, &scene.s, &integrals)?;
    let start = *found.states.first().ok_or("no state")?;
    let torus = Scene { start, ..scene };
    let [_, slow, _] = TorusSolution::new(&torus.problem()?, 1e-6, 0.0)?.rates();
    Ok((TAU / slow.abs(), growth, torus))
}

fn separatrix_logarithm() -> Result<Measured, String> {
    let cases = [1.0, -1.0].into_iter().flat_map(|side| (-5..=-3).map(move |power| (side, power)));
    worst_of(cases, |&(side, power)| {
        let (nearer, _, _) = near_separatrix(0.3, side * 10f64.powi(power - 1))?;
        let (period, growth, _) = near_separatrix(0.3, side * 10f64.powi(power))?;
        Ok(((nearer - period) / (2.0 / growth * 10f64.ln()) - 1.0).abs())
    })
}

fn separatrix_formula() -> Result<Measured, String> {
    let sides = |k| [1.0, -1.0].map(|side| (k, side));
    worst_of([1.0, 0.3, 0.1].into_iter().flat_map(sides), |&(k, side)| {
        worst_of([-2, -4, -6], |&power| {
            let complement = 10f64.powi(power);
            let (period, _, torus) = near_separatrix(k, side * complement)?;
            let FirstIntegrals { energy, spin, .. } = torus.integrals();
            let growth = middle_axis_growth(&torus.body, &torus.s, energy, spin, AveragingOrder::Second)?;
            let x = 0.06 * k * torus.body.constant_c * torus.body.inertia_xx / torus.start.momentum.norm_squared();
            Ok((period_near_separatrix(growth, complement)? / period - 1.0).abs() / x)
        })
    })
}
