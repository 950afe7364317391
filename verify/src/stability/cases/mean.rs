//! The averaged motion: Hamiltonian, generator, slow precession, top, separatrix.

use twofold::solutions::averaged::slow_precession::slow_precession;
use twofold::solutions::averaged::{Top, period_near_separatrix};

use super::parts::*;

/// `c`, `s` (3), `G`, `l` (3), body.
fn hamiltonian<S: Real>(x: &[S], order: AveragingOrder) -> Vec<S> {
    let (s, l, spheroid) = (vector(&x[1..]), vector(&x[5..]), body(&x[8..]));
    let (along, tensor, about) = mean_angular_velocity(&spheroid, &s, x[4], x[0], &l, order);
    vec![mean_potential(&spheroid, &s, x[4], x[0], &l, order), along, tensor.x, tensor.y, tensor.z, about]
}

/// `k` (3), `l` (3), phase.
fn top<S: Real>(k: [S; 3], l: &Vector3<S>, phase: S) -> Vec<S> {
    let top = Top::new(k, l);
    let (rates, squares, shape) = (top.rates, top.mean_squares(), top.at(phase));
    let mut all = vec![rates.slow, rates.about, top.start, squares.x, squares.y, squares.z];
    all.extend(shape.frame.column(2).iter());
    all
}

fn unit<S: Real>(v: Vector3<S>) -> Vector3<S> {
    v / v.dot(&v).sqrt()
}

functions! {
    First: "mean_potential, mean_angular_velocity".composite(), (x) { hamiltonian(x, AveragingOrder::First) }
    Second: "mean_potential, mean_angular_velocity".composite(), (x) { hamiltonian(x, AveragingOrder::Second) }
    // n (3), L (3), s (3), body
    OfGenerator: "generator, generator_slopes".composite(), (x) {
        let (spheroid, s, n, momentum) = (body(&x[9..]), vector(&x[6..]), vector(x), vector(&x[3..]));
        let mut all = vec![generator(&spheroid, &s, &n, &momentum)];
        all.extend(joined(&generator_slopes(&spheroid, &s, &n, &momentum)));
        all
    }
    // deviation of n from l, s, |L|, body
    NearMomentum: "generator".composite(), (x) {
        let n = Vector3::new(x[0], x[1], S::one());
        let momentum = Vector3::new(S::zero(), S::zero(), x[5]);
        let s = vector(&x[2..]);
        vec![generator(&body(&x[6..]), &s, &n, &momentum)]
    }
    // L (3), n (3), s (3), body
    Slow: "slow_precession".composite(), (x) {
        let s = PrincipalCoefficients { xx: x[6], yy: x[7], zz: x[8] };
        slow_precession(&body(&x[9..]), &s, &vector(x), &vector(&x[3..])).map_or(none(1), |found| vec![found.rate])
    }
    // unit of L, L (3), n (3), s (3), body
    SlowInUnits: "slow_precession".composite(), (x) {
        Slow::of(&[&[x[0] * x[1], x[0] * x[2], x[0] * x[3]], &x[4..]].concat())
    }
    // s^YY, s^XX, s^ZZ, L, n, body
    SlowByMiddle: "slow_precession".composite(), (x) {
        let s = PrincipalCoefficients { xx: x[1], yy: x[0], zz: x[2] };
        slow_precession(&body(&x[9..]), &s, &vector(&x[3..]), &vector(&x[6..])).map_or(none(1), |found| vec![found.rate])
    }
    /// `l` (3), `k` (3), phase.
    TopByDirection: "Top: new, rates, start, mean_squares, at".composite().natural_derivatives(), (x) {
        top([x[3], x[4], x[5]], &unit(vector(x)), x[6])
    }
    TopByValues: "Top: new, rates, start, mean_squares, at".composite().natural_derivatives(), (x) {
        top([x[0], x[1], x[2]], &unit(vector(&x[3..])), x[6])
    }
    // s (3), n (3), L (3), e (3), body
    Rates: "AveragedSolution: new, rates".composite(), (x) {
        let n = unit(vector(&x[3..]));
        let across = n.cross(&unit(vector(&x[9..])));
        let state = BodyState { axis: n, momentum: vector(&x[6..]), equatorial_axis: unit(across) };
        let s = PrincipalCoefficients { xx: x[0], yy: x[1], zz: x[2] };
        let problem = Problem::new(body(&x[12..]), s.tensor(), state);
        let motion = problem.and_then(|problem| AveragedSolution::new(&problem, AveragingOrder::Second));
        motion.map_or(none(3), |motion| {
            let rates = motion.rates();
            vec![rates.slow, rates.about_momentum, rates.about_axis]
        })
    }
    // time, n along and across L, |L|, I^xx, I^zz: without Lorentz violation
    ExactTurns(x) {
        let turn = pi::<S>() * 2.0;
        let about_momentum = x[3] / x[4];
        let about_axis = (x[4] - x[5]) * x[1] * x[3] / (x[4] * x[5]);
        [about_momentum, about_axis].map(|rate| {
            let turns = rate * x[0] / turn;
            fraction(turns)
        }).to_vec()
    }
    /// By a product in doubles.
    NaiveTurns(x) {
        let turn = S::from_f64(core::f64::consts::TAU);
        let rates = [x[3] / x[4], (x[4] - x[5]) * x[1] * x[3] / (x[4] * x[5])];
        rates.map(|rate| fraction(rate * x[0] / turn)).to_vec()
    }
    /// Newton's method with the same number of digits.
    ExactGrowth(x) {
        // c, I^zz / I^xx, s (3), |L|
        let three = S::from_f64(3.0);
        let mean = (x[2] + x[3] + x[4]) / three;
        let mut s = [x[2] - mean, x[3] - mean, x[4] - mean];
        s.sort_by(|a, b| a.re().total_cmp(&b.re()));
        let (energy, spin) = energy_and_spin(x);
        let along = x[1] * spin;
        let hamiltonian = energy - mean - along * spin / 2.0 + along * along / 2.0;
        let (h, m) = (s[1], s[1] * s[1]);
        let direction = Vector3::new(S::zero(), S::one(), S::zero());
        let spheroid = body(&[S::one(), x[1], S::one()]);
        let s = Vector3::from(s);
        let mut size = x[5];
        for _ in 0..60 {
            let value = mean_potential(&spheroid, &s, size, along / size, &direction, AveragingOrder::First);
            let c = along / size;
            let slope = size - c * s.y * 3.0 * c / size;
            size -= (size * size / 2.0 + value - hamiltonian) / slope;
        }
        let _ = (h, m);
        let (_, k, _) = mean_angular_velocity(&spheroid, &s, size, along / size, &direction, AveragingOrder::First);
        vec![((k.z - k.y) * (k.y - k.x)).sqrt()]
    }
    ExactPeriodNearSeparatrix(x) {
        vec![S::from_f64(4.0) / x[1] * (S::from_f64(4.0) / x[0].sqrt()).ln()]
    }
}

fn energy_and_spin<S: Real>(x: &[S]) -> (S, S) {
    // As in the kernel: products of the inputs.
    let spin = x[0] * x[5];
    (x[5] * x[5] / 2.0, spin)
}

/// The remainder of a number of turns, in two steps: 31 digits of 1e15 turns leave more of it than a double has.
fn fraction<S: Real>(turns: S) -> S {
    let rest = turns - S::from_f64(turns.re().round());
    rest - S::from_f64(rest.re().round())
}

fn turns(x: &[f64]) -> Vec<f64> {
    let spheroid = body(&[x[4], x[5], 1.0]);
    let state = BodyState {
        axis: Vector3::new(x[2], 0.0, x[1]),
        momentum: Vector3::new(0.0, 0.0, x[3]),
        equatorial_axis: Vector3::new(0.0, 1.0, 0.0),
    };
    let problem = Problem::new(spheroid, Matrix3::zeros(), state);
    let motion = problem.and_then(|problem| AveragedSolution::new(&problem, AveragingOrder::Second));
    motion.map_or(none(2), |motion| {
        let turns = motion.turns([x[0], 0.0]);
        vec![turns.about_momentum.fraction, turns.about_axis.fraction]
    })
}

fn growth(x: &[f64]) -> Vec<f64> {
    let spheroid = body(&[1.0, x[1], 1.0]);
    let s = PrincipalCoefficients { xx: x[2], yy: x[3], zz: x[4] };
    let (energy, spin) = energy_and_spin(x);
    middle_axis_growth(&spheroid, &s, energy, spin, AveragingOrder::First).map_or(none(1), |rate| vec![rate])
}

fn period(x: &[f64]) -> Vec<f64> {
    period_near_separatrix(x[1], x[0]).map_or(none(1), |period| vec![period])
}

const SMALL: Input = Signed(-4.0, -1.0);

pub(super) fn cases() -> Vec<Case> {
    let (c, i) = (COMPONENT, INERTIA);
    let third = Near(0.577_350_269_189_625_7, -15.0, -0.5);
    let hamiltonian = |first: Input, s: Input| [first, s, s, s, In(0.5, 2.0), c, c, c, i, i, In(0.5, 2.0)];
    let state = [c, c, c, c, c, c];
    let slow = |l: [Input; 3], s: [Input; 3]| [&l[..], &[c, c, c], &s[..], &[i, i, i]].concat();
    let three = [In(0.01, 0.05), In(-0.01, 0.005), In(-0.05, -0.02)];
    let middle = Signed(-15.0, -0.5);
    vec![
        First::case("c^2 -> 1/3, first order", &hamiltonian(third, SMALL)),
        Second::case("c^2 -> 1/3, second order", &hamiltonian(third, SMALL)),
        Second::case("c -> 0, L normal to n", &hamiltonian(Signed(-300.0, 0.0), SMALL)),
        Second::case("s from 1e-140 to 1", &hamiltonian(c, Signed(-140.0, 0.0))),
        OfGenerator::case("s from 1e-140 to 1", &[&state[..], &[Signed(-140.0, 0.0); 3], &[i, i, i]].concat()),
        NearMomentum::case("n -> L", &list![Signed(-15.0, 0.0); 2, SMALL; 3, In(0.5, 2.0), i; 3]),
        Slow::case("separatrix: L -> the middle axis", &slow([middle, In(0.5, 1.0), Signed(-15.0, -0.5)], three)),
        Slow::case("L normal to the axis of s_1", &slow([middle, c, c], three)),
        SlowByMiddle::case(
            "equal and nearly equal eigenvalues",
            &list![Near(0.03, -15.0, -2.0), Fixed(0.03), In(-0.05, 0.0), c; 6, i; 3],
        ),
        SlowInUnits::case("units: L from 1e-60 to 1e60", &[&[Log(-60.0, 60.0)], &slow([c, c, c], three)[..]].concat()),
        TopByDirection::case(
            "separatrix: l -> the middle axis",
            &[Signed(-7.0, -0.5), In(0.5, 1.0), Signed(-7.0, -0.5), three[0], three[1], three[2], In(-3.0, 3.0)],
        ),
        TopByDirection::case(
            "l -> a stable axis",
            &[Signed(-15.0, -1.0), Signed(-15.0, -1.0), In(0.5, 1.0), three[0], three[1], three[2], In(-3.0, 3.0)],
        ),
        TopByValues::case(
            "equal and nearly equal eigenvalues",
            &list![Near(0.03, -15.0, -2.0), Fixed(0.03), In(-0.05, 0.0), c; 3, In(-3.0, 3.0)],
        ),
        Rates::case(
            "s -> 0",
            &list![Signed(-100.0, -2.5), Signed(-3.5, -2.5); 2, c; 3, In(0.5, 1.0); 3, c; 3, i; 2, In(0.5, 1.0)],
        ),
        Case::of_doubles::<ExactTurns>(
            "AveragedSolution::turns",
            "t to 1e15, in turns",
            &[Log(0.0, 15.0), Fixed(0.8), Fixed(0.6), In(0.5, 2.0), i, i],
            turns,
        )
        .beside::<NaiveTurns>("a product in doubles")
        .composite()
        .unit(),
        Case::of_doubles::<ExactGrowth>(
            "middle_axis_growth",
            "c^2 -> 1/3",
            &[Near(0.577_350_269_189_625_7, -8.0, -1.0), In(1.0, 1.2), three[0], three[1], three[2], In(0.8, 1.5)],
            growth,
        )
        .composite(),
        Case::of_doubles::<ExactPeriodNearSeparatrix>(
            "period_near_separatrix",
            "k' -> 0",
            &[Log(-190.0, 0.0), Log(-10.0, 10.0)],
            period,
        ),
    ]
}
