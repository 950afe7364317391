//! Frequencies: exact ones from the periods of the torus, against known ones; those of the averaged motion, against the exact ones.

use core::f64::consts::{PI, TAU};

use nalgebra::Vector3;
use num_dual::Dual64;
use twofold::dynamics::first_integrals::{FirstIntegrals, first_integrals};
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::observables::fundamental_frequencies::fundamental_frequencies;
use twofold::propagation::{Motion, propagate};
use twofold::solutions::averaged::{AveragedSolution, AveragingOrder, middle_axis_growth, period_near_separatrix};
use twofold::solutions::symmetric::SymmetricSolution;
use twofold::solutions::torus::{TorusFrequencies, separatrix_motion, states_with_integrals, torus_frequencies};

use crate::check::{Bound, Check, Kind, Measured, Worst, largest};
use crate::random::Random;
use crate::reference::reference_motion;
use twofold::straight_line::slope;

/// Checks of this subject.
pub fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "torus-states",
            kind: Kind::Property,
            equations: &[24],
            statement: "states found from (E, Omega^z, K) of random motions, twofold and single, have these integrals, and one of them lies on the motion's own torus: it has the same frequencies",
            figure: "largest of: difference of an integral / its size; difference of a frequency / rotation rate / 10; 60 random motions",
            bound: Bound::AtMost(1e-13),
            reason: "K is met to 1e-13 of its size by construction; frequencies to 1e-12 of the rotation rate were asked",
            measure: states,
        },
        Check {
            id: "torus-frequencies-examples",
            kind: Kind::Oracle,
            equations: &[32, 57],
            statement: "exact frequencies of the four examples are those of integration over 20,000 t_c with quadruple precision checks: the mean rates of alpha and gamma are sums of them",
            figure: "largest difference beyond half a unit of the reference's last digit [1/t_c]",
            bound: Bound::AtMost(1e-13),
            reason: "rounding of a few periods; the references are given to 1e-11 and 1e-10",
            measure: examples,
        },
        Check {
            id: "torus-frequencies-symmetric",
            kind: Kind::Oracle,
            equations: &[25, 26],
            statement: "with two equal eigenvalues the exact frequencies are those of the exact solution in elliptic functions: slow and about_axis are alpha' and gamma' but for whole turns of the nutation, which is about_momentum less the slow one",
            figure: "largest difference / rotation rate, 12 random motions of both kinds",
            bound: Bound::AtMost(1e-12),
            reason: "asked of them; both sides lose some digits where the torus is thin",
            measure: symmetric,
        },
        Check {
            id: "torus-frequencies-same-torus",
            kind: Kind::Property,
            equations: &[25],
            statement: "from states later in the same motion the exact frequencies are the same: differences are within the sum of the estimated errors, and below 1e-12 of the rate",
            figure: "largest of: difference / sum of the estimates; relative difference / 1e-12; tp-1, tp-2, sp-1, sp-2 and tp-2 with s scaled by 0.3, 0.1",
            bound: Bound::AtMost(1.0),
            reason: "the estimate is that of the rounding of a period over the thickness of the torus",
            measure: same_torus,
        },
        Check {
            id: "torus-frequencies-averages",
            kind: Kind::Oracle,
            equations: &[57],
            statement: "the exact frequencies of tp-II are weighted averages over 4,800 and 9,600 t_c of numerical motion",
            figure: "largest difference, relative, of the slow frequency",
            bound: Bound::AtMost(1e-12),
            reason: "asked of it; windowed averages leak less than that",
            measure: averages,
        },
        Check {
            id: "mean-frequency-first",
            kind: Kind::Regime,
            equations: &[57],
            statement: "the slow frequency of tp-II, 0.03546436867 / t_c, follows from the averaged motion of first order to 5 %",
            figure: "relative error",
            bound: Bound::AtMost(0.05),
            reason: "asked of it; of first order in the strength of the torque, 0.024",
            measure: || slow_frequency(AveragingOrder::First, 1.0),
        },
        Check {
            id: "mean-frequency-second",
            kind: Kind::Regime,
            equations: &[57],
            statement: "and from that of second order to 0.5 %",
            figure: "relative error",
            bound: Bound::AtMost(0.005),
            reason: "asked of it; of second order in the strength of the torque",
            measure: || slow_frequency(AveragingOrder::Second, 1.0),
        },
        Check {
            id: "mean-frequency-slopes",
            kind: Kind::Regime,
            equations: &[57],
            statement: "its relative errors fall with the first and the second power of s",
            figure: "largest |measured slope - order|, tp-II with s scaled by 0.1 to 1e-3",
            bound: Bound::AtMost(0.05),
            reason: "corrections of relative order k",
            measure: slopes,
        },
        Check {
            id: "mean-frequency-random",
            kind: Kind::Regime,
            equations: &[57],
            statement: "all three rates of second order are right to the third power of the strength of the torque, for random motions of both kinds, on both sides of the separatrix",
            figure: "largest |mean - exact| / (x^3 G / I^xx), x = C (s_max - s_min) I^xx / G^2 from 0.001 to 0.02, 60 random motions with k'^2 above 0.05",
            bound: Bound::AtMost(15.0),
            reason: "coefficients of order one, over the distance from the separatrix",
            measure: random_rates,
        },
        Check {
            id: "mean-lines-of-examples",
            kind: Kind::Regime,
            equations: &[57],
            statement: "the lines that the paper marks at the free values 1.438 and 0.1 are at alpha' and gamma' by sums of the averaged motion's rates to second order",
            figure: "largest |formula - exact| / |free value - exact|, alpha' and gamma' of tp-I and tp-II",
            bound: Bound::AtMost(0.01),
            reason: "third order against first, at a strength of 0.03",
            measure: lines,
        },
        Check {
            id: "middle-axis-growth-orders",
            kind: Kind::Regime,
            equations: &[36],
            statement: "the growth rate at the middle axis is that of the monodromy matrix of the unstable periodic motion to first and to second order; for a spin along the axis that of a closed quartic",
            figure: "largest |measured slope of the relative error - order|, s of the examples scaled by 1 to 0.03, n turning about L at 0, 0.4 and 1.1 rad",
            bound: Bound::AtMost(0.15),
            reason: "corrections of relative order 0.06",
            measure: growth_orders,
        },
        Check {
            id: "middle-axis-growth-exact",
            kind: Kind::Regime,
            equations: &[36],
            statement: "with the examples' s the second-order growth rate is right to half a percent",
            figure: "largest relative error, n turning about L at 0, 0.4 and 1.1 rad",
            bound: Bound::AtMost(0.005),
            reason: "second order in a strength of 0.03 to 0.05, as for the slow frequency",
            measure: growth_of_examples,
        },
        Check {
            id: "separatrix-period-logarithm",
            kind: Kind::Regime,
            equations: &[36],
            statement: "towards the separatrix the exact slow period grows by (2 / mu) ln 10 per tenth of the distance in K, with the exact mu",
            figure: "largest relative difference, both sides, from k'^2 = 1e-3 to 1e-6",
            bound: Bound::AtMost(1e-3),
            reason: "the next term is k'^2 ln k' / 2, over 2.3",
            measure: separatrix_logarithm,
        },
        Check {
            id: "separatrix-period-formula",
            kind: Kind::Regime,
            equations: &[36],
            statement: "the slow period near the separatrix is (4 / mu) ln(4 / k') with mu of second order and k' from K",
            figure: "largest relative difference / strength of the torque, both sides, k'^2 from 1e-2 to 1e-6, s of the examples scaled by 1, 0.3, 0.1",
            bound: Bound::AtMost(1.0),
            reason: "k' is of first order in the strength, as the logarithm's constant",
            measure: separatrix_formula,
        },
    ]
}

struct Scene {
    body: RigidSpheroid<f64>,
    s: PrincipalCoefficients<f64>,
    start: BodyState<f64>,
}

impl Scene {
    fn example(name: &str, k: f64) -> Self {
        let scene = reference_motion(name);
        Self { body: scene.spheroid, s: scene.coefficients.scaled(k), start: scene.initial() }
    }

    fn torus(&self) -> Result<TorusFrequencies, String> {
        torus_frequencies(&self.body, &self.s, &self.start).map_err(String::from)
    }

    /// Exact rates: `slow`, `about_momentum`, `about_axis`.
    fn exact(&self) -> Result<[f64; 3], String> {
        let found = self.torus()?;
        let name = |rate: Option<f64>| rate.ok_or("the rates have no names");
        Ok([found.slow, name(found.about_momentum)?, name(found.about_axis)?])
    }

    /// Rates of the averaged motion with the names and signs of the exact ones.
    fn mean(&self, order: AveragingOrder) -> Result<[f64; 3], String> {
        let mean = AveragedSolution::new(&self.body, &self.s, &self.start, order)?;
        let rates = mean.rates();
        Ok([rates.slow.abs(), rates.about_momentum, rates.about_axis])
    }

    fn integrals(&self) -> FirstIntegrals<f64> {
        first_integrals(&self.body, &self.s.tensor(), &self.start)
    }

    fn rotation(&self) -> f64 {
        self.start.momentum.norm() / self.body.inertia_xx
    }

    /// A motion with a strength of the torque between `x` and three times that. Every fourth one a single precession.
    fn random(random: &mut Random, case: usize, strength: f64) -> Self {
        let mut body = RigidSpheroid::in_units_of_tc(random.within(0.6, 1.6));
        body.inertia_xx = random.within(0.5, 2.0);
        body.inertia_zz *= body.inertia_xx;
        body.constant_c = random.within(0.5, 2.0);
        let mut direction = || Vector3::from_fn(|_, _| random.within(-1.0, 1.0)).normalize();
        let (l, other) = (direction(), direction());
        let n = if case.is_multiple_of(4) { (l + other * 0.05).normalize() } else { other };
        let momentum = l * random.within(0.5, 3.0);
        let values = [1.0, random.within(-0.7, 0.7), -1.0];
        let at = case % 3;
        let values = [values[at], values[(at + 1) % 3], values[(at + 2) % 3]];
        let scale =
            strength * random.within(1.0, 3.0) * momentum.norm_squared() / (2.0 * body.constant_c * body.inertia_xx);
        let equatorial_axis = n.cross(&Vector3::new(0.3, -0.5, 0.8)).normalize();
        let s = PrincipalCoefficients::new(values).scaled(scale);
        Self { body, s, start: BodyState { axis: n, momentum, equatorial_axis } }
    }

    /// Distance from the separatrix: `k'^2` by `l` at the start.
    fn complement(&self) -> f64 {
        let l = self.start.momentum.normalize();
        let mut order = [0, 1, 2];
        let values = [self.s.xx, self.s.yy, self.s.zz];
        order.sort_by(|&i, &j| values[j].total_cmp(&values[i]));
        let [s1, s2, s3] = order.map(|i| values[i]);
        let [a, _, c] = order.map(|i| l[i] * l[i]);
        let below = (s2 - s3) * c - (s1 - s2) * a;
        let h = s2 - below;
        let p_squared = if below > 0.0 { (s2 - s3) * (s1 - h) } else { (s1 - s2) * (h - s3) };
        (s1 - s3) * below.abs() / p_squared
    }
}

fn states() -> Result<Measured, String> {
    let (mut random, mut worst, mut followed) = (Random::with_seed(71), Worst::default(), 0);
    for case in 0..60 {
        let scene = Scene::random(&mut random, case, [0.003, 0.03][case % 2]);
        if scene.complement() < 0.05 {
            continue;
        }
        followed += 1;
        let (integrals, axis, exact) = (scene.integrals(), scene.torus()?.axis, scene.exact()?);
        let found = states_with_integrals(&scene.body, &scene.s, &integrals)?;
        if found.round != Some(axis) {
            return Err(format!("case {case} of seed 71: L goes round {:?}, not {axis}", found.round));
        }
        let square = scene.start.momentum.norm_squared();
        let spread = scene.s.xx.abs() + scene.s.yy.abs() + scene.s.zz.abs();
        let mut nearest = f64::INFINITY;
        for start in &found.states {
            let state = Scene { start: *start, ..scene };
            let again = state.integrals();
            let differences = [
                (again.energy - integrals.energy) / integrals.energy,
                (again.spin - integrals.spin) / scene.rotation(),
                (again.clebsch - integrals.clebsch) / (square * spread),
            ];
            worst.see(largest(differences.map(f64::abs)), || format!("case {case} of seed 71, {differences:?}"));
            let other = state.exact()?;
            let rates = [other[0].abs() - exact[0].abs(), other[1] - exact[1], other[2] - exact[2]];
            nearest = nearest.min(largest(rates.map(|rate| (rate / scene.rotation()).abs())));
        }
        worst.see(nearest / 10.0, || format!("case {case} of seed 71: frequencies differ by {nearest:e}"));
    }
    if followed < 40 {
        return Err(format!("only {followed} of 60 motions are away from the separatrix"));
    }
    worst.finish()
}

/// Mean rates of alpha and gamma: whole sums of the frequencies, named by the motion.
struct Angles {
    alpha: [f64; 3],
    gamma: [f64; 3],
}

/// Which multiples of `slow`, `about_momentum` and `about_axis` the mean rates of alpha and gamma are.
const TWOFOLD: Angles = Angles { alpha: [0.0, 1.0, 0.0], gamma: [0.0, 0.0, 1.0] };
const SINGLE: Angles = Angles { alpha: [1.0, 0.0, 0.0], gamma: [-1.0, 1.0, 1.0] };

fn sum(rates: [f64; 3], multiples: [f64; 3]) -> f64 {
    rates.iter().zip(multiples).map(|(rate, multiple)| rate * multiple).sum()
}

fn examples() -> Result<Measured, String> {
    let expected = [
        ("tp-1", TWOFOLD, 1.51237304762, -0.15557827845, f64::NAN, 1e-11),
        ("tp-2", TWOFOLD, 1.39467831103, -0.14421753117, -0.03546436867, 1e-11),
        ("sp-1", SINGLE, -0.0720704306, 1.0549619690, -0.0720704306, 1e-10),
        ("sp-2", SINGLE, -0.0257600721, 1.0086796666, -0.0257600721, 1e-10),
    ];
    let mut worst = Worst::default();
    for (name, angles, alpha, gamma, slow, digit) in expected {
        let rates = Scene::example(name, 1.0).exact()?;
        let mut pairs = vec![("alpha", sum(rates, angles.alpha), alpha), ("gamma", sum(rates, angles.gamma), gamma)];
        // The azimuth of L of tp-1 counts turns of alpha.
        if !slow.is_nan() {
            pairs.push(("L", rates[0], slow));
        }
        for (what, rate, expected) in pairs {
            let beyond = (rate - expected).abs() - digit / 2.0;
            worst.see(if beyond < 0.0 { 0.0 } else { beyond }, || format!("{what} of {name}: {rate:.14}; {rates:?}"));
        }
    }
    worst.finish()
}

fn symmetric() -> Result<Measured, String> {
    let (mut random, mut worst) = (Random::with_seed(72), Worst::default());
    for case in 0..12 {
        let body = RigidSpheroid::in_units_of_tc(random.within(0.8, 1.3));
        let equatorial = random.within(-0.02, 0.02);
        let s = PrincipalCoefficients::new([equatorial, equatorial, equatorial - random.within(0.01, 0.06)]);
        let angles = EulerAngles { alpha: 0.3, beta: random.within(0.6, 0.9), gamma: -1.0 };
        let twofold = case % 2 == 0;
        let (alpha_rate, gamma_rate) = if twofold { (1.5, -0.15) } else { (-0.07, 1.1) };
        let rates = EulerRates { alpha: alpha_rate, beta: random.within(0.05, 0.1), gamma: gamma_rate };
        let closed = SymmetricSolution::new(&body, &s, &angles, &rates)?;
        let scene = Scene { body, s, start: BodyState::from_angles(&body, &angles, &rates) };
        let exact = scene.exact()?;
        let (mean, nutation) = (closed.mean_rates(), TAU / closed.period());
        // The inclination repeats, so that angles differ by whole turns of the nutation.
        let off = |value: f64, expected: f64| {
            let turns = ((value - expected) / nutation).round();
            (value - expected - turns * nutation).abs()
        };
        let side = scene.start.momentum.z.signum();
        let differences =
            [off(exact[0], mean.alpha), (exact[1] - side * exact[0] - nutation).abs(), off(exact[2], mean.gamma)];
        worst.see(largest(differences) / scene.rotation(), || {
            format!("case {case} of seed 72: {differences:?}, {exact:?}, {mean:?}, nutation {nutation}")
        });
    }
    worst.finish()
}

fn same_torus() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for (name, k) in [("tp-1", 1.0), ("tp-2", 1.0), ("sp-1", 1.0), ("sp-2", 1.0), ("tp-2", 0.3), ("tp-2", 0.1)] {
        let scene = Scene::example(name, k);
        let (first, known) = (scene.exact()?, scene.torus()?.uncertainty);
        let motion = propagate(&scene.body, &scene.s.tensor(), &scene.start, (0.0, 300.0), 1e-15)?;
        for t in [7.3, 41.0, 300.0] {
            let later = Scene { start: motion.state(t)?, ..scene };
            let (rates, errors) = (later.exact()?, later.torus()?.uncertainty);
            for i in 0..3 {
                let (a, b) = (first[i], rates[i]);
                let (estimate, off) = (known[i] + errors[i], (a - b).abs());
                worst.see(largest([off / estimate, off / a.abs() / 1e-12]), || {
                    format!("rate {i} of {name}, k = {k}, t = {t}: {off:.1e} of {a}, estimate {estimate:.1e}")
                });
            }
        }
    }
    worst.finish()
}

fn averages() -> Result<Measured, String> {
    let scene = Scene::example("tp-2", 1.0);
    let exact = scene.exact()?;
    let mut worst = Worst::default();
    for span in [4800.0, 9600.0] {
        let motion = propagate(&scene.body, &scene.s.tensor(), &scene.start, (0.0, span), 1e-16)?;
        let slow = fundamental_frequencies(&motion)?.slow.ok_or("no slow precession")?;
        worst.see((slow.value / exact[0] - 1.0).abs(), || format!("{span}: {:.16} and {:.16}", slow.value, exact[0]));
    }
    worst.finish()
}

fn error_of_slow(order: AveragingOrder, k: f64) -> Result<(f64, f64, f64), String> {
    let scene = Scene::example("tp-2", k);
    let (exact, mean) = (scene.exact()?[0].abs(), scene.mean(order)?[0]);
    Ok(((mean / exact - 1.0).abs(), mean, exact))
}

fn slow_frequency(order: AveragingOrder, k: f64) -> Result<Measured, String> {
    let (error, mean, exact) = error_of_slow(order, k)?;
    let others = [0.3, 0.1].map(|k| error_of_slow(order, k).map(|(error, ..)| format!("k = {k}: {error:.2e}")));
    let [a, b] = others;
    Ok(Measured::new(error, format!("mean {mean:.8}, exact {exact:.14}; {}, {}", a?, b?)))
}

fn slopes() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for (order, expected) in [(AveragingOrder::First, 1.0), (AveragingOrder::Second, 2.0)] {
        let points = [0.1, 0.03, 0.01, 3e-3, 1e-3]
            .map(|k| error_of_slow(order, k).map(|(error, ..)| (f64::log10(k), error.log10())));
        let points: Vec<_> = points.into_iter().collect::<Result<_, _>>()?;
        let fit = slope(&points)?;
        worst.see((fit.value - expected).abs(), || format!("{order:?}: {:.3} +- {:.3}", fit.value, fit.error));
    }
    worst.finish()
}

fn random_rates() -> Result<Measured, String> {
    let (mut random, mut worst, mut followed) = (Random::with_seed(73), Worst::default(), 0);
    for case in 0..60 {
        let scene = Scene::random(&mut random, case, [0.001, 0.007][case % 2]);
        if scene.complement() < 0.05 {
            continue;
        }
        followed += 1;
        let exact = scene.exact()?;
        let mean = scene.mean(AveragingOrder::Second)?;
        let x = AveragedSolution::new(&scene.body, &scene.s, &scene.start, AveragingOrder::Second)?.relative_strength();
        let differences = [mean[0] - exact[0].abs(), mean[1] - exact[1], mean[2] - exact[2]]
            .map(|d| d.abs() / (x.powi(3) * scene.rotation()));
        worst.see(largest(differences), || {
            format!("case {case} of seed 73: x = {x:.4}, {differences:?}, k'^2 = {:.3}", scene.complement())
        });
    }
    if followed < 40 {
        return Err(format!("only {followed} of 60 motions are away from the separatrix"));
    }
    worst.finish()
}

fn lines() -> Result<Measured, String> {
    let mut worst = Worst::default();
    let free = [1.1 / f64::cos(0.7), -0.1];
    for name in ["tp-1", "tp-2"] {
        let scene = Scene::example(name, 1.0);
        let exact = scene.exact()?;
        let mut mean = scene.mean(AveragingOrder::Second)?;
        mean[0] *= exact[0].signum();
        for (what, multiples, free) in [("alpha'", TWOFOLD.alpha, free[0]), ("gamma'", TWOFOLD.gamma, free[1])] {
            let (exact, mean) = (sum(exact, multiples), sum(mean, multiples));
            worst.see((mean - exact).abs() / (free - exact).abs(), || {
                format!("{what} of {name}: exact {exact:.9}, formula {mean:.9}, free {free:.4}")
            });
        }
    }
    worst.finish()
}

/// A star whose axis turns about `L` at the angle `nutation`, `L` about the middle axis of the examples' s scaled by `k`: the unstable periodic motion, with
/// its exact growth rate.
fn unstable(k: f64, nutation: f64) -> Result<(Scene, f64), String> {
    let (body, s) = (RigidSpheroid::in_units_of_tc(1.1), PrincipalCoefficients::new([0.02, 0.01, -0.04]).scaled(k));
    let g = 1.4;
    if nutation == 0.0 {
        let start = BodyState { axis: Vector3::y(), momentum: Vector3::y() * g, equatorial_axis: Vector3::x() };
        // (l^2 + p)(l^2 - q) + g^2 l^2 = 0 with I^xx = C = 1.
        let (p, q) = (2.0 * (s.xx - s.yy), 2.0 * (s.yy - s.zz));
        let b = g * g + p - q;
        // Without cancellation.
        let square = 2.0 * p * q / (b + (b * b + 4.0 * p * q).sqrt());
        return Ok((Scene { body, s, start }, square.sqrt()));
    }
    let spin = g * f64::cos(nutation) / body.inertia_zz;
    let energy = (g * f64::sin(nutation)).powi(2) / 2.0 + body.inertia_zz * spin * spin / 2.0;
    let start = separatrix_motion(&body, &s, energy, spin)?;
    let scene = Scene { body, s, start };
    // The period: n and L are in the same plane again, twice each turn.
    let motion = propagate(&body, &s.tensor(), &start, (0.0, 10.0), 1e-16)?;
    let out = |t: f64| motion.state(t).map(|state| state.axis.z).map_err(String::from);
    let (mut left, mut right) = (0.9 * TAU / g, 1.1 * TAU / g);
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
    // Trace of the monodromy matrix of (n, L): four of its eigenvalues are one, two exp(+-mu T).
    let lifted = body.map(Dual64::from_re);
    let mut excess = -6.0;
    for place in 0..6 {
        let mut vectors = [start.axis, start.momentum].map(|v| v.map(Dual64::from_re));
        vectors[place / 3][place % 3].eps = 1.0;
        let [axis, momentum] = vectors;
        let initial = twofold::propagation::AxisState { axis, momentum };
        let tensor = s.tensor().map(Dual64::from_re);
        let moved = twofold::propagation::propagate_axis(&lifted, &tensor, &initial, (0.0, period), 1e-16)?;
        let end = twofold::propagation::Motion::axis_state(&moved, Dual64::from_re(period))?;
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
    let mut worst = Worst::default();
    for nutation in NUTATIONS {
        for (order, expected) in [(AveragingOrder::First, 1.0), (AveragingOrder::Second, 2.0)] {
            let points =
                [0.3, 0.1, 0.03].map(|k| growth_error(order, k, nutation).map(|error| (f64::log10(k), error.log10())));
            let points: Vec<_> = points.into_iter().collect::<Result<_, _>>()?;
            let fit = slope(&points)?;
            worst.see((fit.value - expected).abs(), || {
                format!("{order:?}, {nutation}: {:.3} +- {:.3}, {points:?}", fit.value, fit.error)
            });
        }
    }
    worst.finish()
}

fn growth_of_examples() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for nutation in NUTATIONS {
        let first = growth_error(AveragingOrder::First, 1.0, nutation)?;
        worst.see(growth_error(AveragingOrder::Second, 1.0, nutation)?, || {
            format!("at {nutation}; to first order {first:.4}")
        });
    }
    worst.finish()
}

/// Exact slow period at a distance `k'^2` (signed) from the separatrix of the examples' s scaled by `k`, the growth rate and the strength of the torque.
fn near_separatrix(k: f64, complement: f64) -> Result<(f64, f64, Scene), String> {
    let (scene, growth) = unstable(k, 0.7)?;
    let mut integrals = scene.integrals();
    let PrincipalCoefficients { xx: s1, yy: s2, zz: s3 } = scene.s;
    integrals.clebsch += complement * (s1 - s2) * (s2 - s3) / (s1 - s3) * scene.start.momentum.norm_squared();
    let found = states_with_integrals(&scene.body, &scene.s, &integrals)?;
    let start = *found.states.first().ok_or("no state")?;
    let torus = Scene { start, ..scene };
    Ok((TAU / torus.torus()?.slow.abs(), growth, torus))
}

fn separatrix_logarithm() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for side in [1.0, -1.0] {
        let mut last: Option<f64> = None;
        for power in -6..=-3 {
            let (period, growth, _) = near_separatrix(0.3, side * 10f64.powi(power))?;
            if let Some(last) = last {
                let expected = 2.0 / growth * 10f64.ln();
                worst.see(((last - period) / expected - 1.0).abs(), || {
                    format!("from 1e{} to 1e{power}, side {side}", power - 1)
                });
            }
            last = Some(period);
        }
    }
    worst.finish()
}

fn separatrix_formula() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for k in [1.0, 0.3, 0.1] {
        for side in [1.0, -1.0] {
            for power in [-2, -4, -6] {
                let complement = 10f64.powi(power);
                let (period, _, torus) = near_separatrix(k, side * complement)?;
                let FirstIntegrals { energy, spin, .. } = torus.integrals();
                let growth = middle_axis_growth(&torus.body, &torus.s, energy, spin, AveragingOrder::Second)?;
                let formula = period_near_separatrix(growth, complement)?;
                let x = 0.06 * k / torus.start.momentum.norm_squared();
                let off = (formula / period - 1.0).abs();
                worst.see(off / x, || {
                    format!("k = {k}, side {side}, k'^2 = {complement:e}: {off:.2e}, period {:.1} pi", period / PI)
                });
            }
        }
    }
    worst.finish()
}
