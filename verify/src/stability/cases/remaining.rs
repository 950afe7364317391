//! Multipoles of any star, states on tori, exact frequencies, distribution of eta, epochs.

use core::f64::consts::TAU;

use twofold::Real;
use twofold::dynamics::BodyState;
use twofold::dynamics::first_integrals::{FirstIntegrals, first_integrals};
use twofold::epoch::{DAY, Epoch};
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::observables::eta_distribution::EtaDistribution;
use twofold::solutions::symmetric::SymmetricSolution;
use twofold::solutions::torus::{separatrix_motion, states_with_integrals, torus_frequencies};
use twofold::star::axisymmetric::axisymmetric_integrals;
use twofold::star::spheroid_shape::SpheroidShape;
use twofold::star::uniform_spheroid::UniformSpheroid;

use super::parts::{angles, body, none, rates};
use crate::stability::Input::{self, Fixed, In, Log, Signed};
use crate::stability::{Case, Wide, functions};

fn wide(x: f64) -> Wide {
    <Wide as twofold::Scalar>::from_f64(x)
}

functions! {
    Multipoles: "axisymmetric_integrals", (x) {
        let shape = SpheroidShape::from_eccentricity(x[0]).expect("a shape");
        let star = UniformSpheroid::new(S::one(), S::one(), shape).expect("a star");
        axisymmetric_integrals(&star, 4).map_or(none(6), |all| {
            let (i, u) = (all.moment_of_inertia, all.potential_energy_tensor);
            vec![all.mass, i.xx, i.zz, u.xx, u.zz, all.c]
        })
    }
    // energy, spin, K of a state of these angles and rates, as they were asked for
    Asked(x) {
        let (spheroid, s, state) = scene(x);
        let all = first_integrals(&spheroid, &s.tensor(), &state);
        vec![all.energy, all.spin, all.clebsch]
    }
    AskedOfSeparatrix(x) { Asked::of(x)[..2].to_vec() }
    OfSymmetric(x) {
        let (spheroid, s, angles, rates) = twofold(x);
        SymmetricSolution::new(&spheroid, &s, &angles, &rates).map_or(none(2), |motion| {
            let mean = motion.mean_rates();
            vec![mean.alpha, mean.gamma]
        })
    }
    // probability, speeds (2), weights (2)
    Probability(x) { vec![S::one() - x[0]] }
    RootMeanSquare(x) {
        let (v, w) = ([x[1], x[2]], [x[3], x[4]]);
        vec![(S::from_f64(3.0) * (w[0] + w[1]) / (w[0] * v[0] * v[0] + w[1] * v[1] * v[1])).sqrt()]
    }
    // seconds, fraction
    Seconds(x) { vec![x[0]] }
    Fraction(x) {
        let days = x[1] + x[0] / DAY;
        vec![days - S::from_f64(days.re().floor())]
    }
}

type Scene<S> = (twofold::dynamics::RigidSpheroid<S>, PrincipalCoefficients<S>, BodyState<S>);

/// `s` (ZZ, XX, YY), angles, rates, `I^zz`.
fn scene<S: Real>(x: &[S]) -> Scene<S> {
    let spheroid = body(&[S::one(), x[9], S::one()]);
    let s = PrincipalCoefficients { xx: x[1], yy: x[2], zz: x[0] };
    let state = BodyState::from_angles(&spheroid, &angles(&x[3..]), &rates(&x[6..]));
    (spheroid, s, state)
}

type Twofold<S> = (twofold::dynamics::RigidSpheroid<S>, PrincipalCoefficients<S>, EulerAngles<S>, EulerRates<S>);

/// Nearly free precession about Z for a tensor symmetric about Z: `s^ZZ`, beta, `I^zz`, changes of two rates.
fn twofold<S: Real>(x: &[S]) -> Twofold<S> {
    let spheroid = body(&[S::one(), x[2], S::one()]);
    let s = PrincipalCoefficients { xx: S::zero(), yy: S::zero(), zz: x[0] };
    let (_, cos) = x[1].sin_cos();
    let alpha = x[2] / cos + x[3];
    let rates = EulerRates { alpha, beta: x[4], gamma: S::one() - alpha * cos };
    (spheroid, s, EulerAngles { alpha: S::one(), beta: x[1], gamma: S::one() }, rates)
}

fn wide_integrals(x: &[f64], state: &BodyState<f64>) -> Vec<f64> {
    let (spheroid, s, _) = scene(&x.iter().map(|&x| wide(x)).collect::<Vec<_>>());
    let state = BodyState {
        axis: state.axis.map(wide),
        momentum: state.momentum.map(wide),
        equatorial_axis: state.equatorial_axis.map(wide),
    };
    let all = first_integrals(&spheroid, &s.tensor(), &state);
    [all.energy, all.spin, all.clebsch].map(|value| value.high()).to_vec()
}

fn rounded(x: &[f64]) -> FirstIntegrals<f64> {
    let wide: Vec<Wide> = x.iter().map(|&x| wide(x)).collect();
    use crate::stability::Function;
    let [energy, spin, clebsch] = [0, 1, 2].map(|i| Asked::of(&wide)[i].high());
    FirstIntegrals { energy, spin, clebsch }
}

fn states(x: &[f64]) -> Vec<f64> {
    let (spheroid, s, _) = scene(x);
    let found = states_with_integrals(&spheroid, &s, &rounded(x));
    found.map_or(none(3), |found| found.states.first().map_or(none(3), |state| wide_integrals(x, state)))
}

fn separatrix(x: &[f64]) -> Vec<f64> {
    let (spheroid, s, _) = scene(x);
    let FirstIntegrals { energy, spin, .. } = rounded(x);
    separatrix_motion(&spheroid, &s, energy, spin).map_or(none(2), |state| wide_integrals(x, &state)[..2].to_vec())
}

fn frequencies(x: &[f64]) -> Vec<f64> {
    let (spheroid, s, angles, rates) = twofold(x);
    let state = BodyState::from_angles(&spheroid, &angles, &rates);
    torus_frequencies(&spheroid, &s, &state)
        .map_or(none(2), |found| vec![found.about_momentum.unwrap_or(f64::NAN), found.about_axis.unwrap_or(f64::NAN)])
}

fn two_speeds(x: &[f64]) -> Option<EtaDistribution> {
    EtaDistribution::from_speeds([(x[1], x[3]), (x[2], x[4])]).ok()
}

fn probability(x: &[f64]) -> Vec<f64> {
    two_speeds(x).map_or(none(1), |of| of.quantile(x[0]).map_or(none(1), |eta| vec![of.probability_above(eta)]))
}

fn root_mean_square(x: &[f64]) -> Vec<f64> {
    two_speeds(x).map_or(none(1), |of| vec![of.root_mean_square()])
}

fn epoch(x: &[f64]) -> Option<Epoch> {
    Epoch::new(50_000, x[1]).ok()
}

fn seconds(x: &[f64]) -> Vec<f64> {
    // From the start of the day, where the fraction is that of the seconds.
    let (start, days) = (Epoch::new(50_000, 0.0).expect("a date"), x[0] / DAY);
    let end = start.after([x[0], 0.0]).expect("a date");
    let [high, low] = end.seconds_since(&start);
    debug_assert!(days.is_finite());
    vec![high + low]
}

fn fraction(x: &[f64]) -> Vec<f64> {
    epoch(x).map_or(none(1), |start| start.after([x[0], 0.0]).map_or(none(1), |end| vec![end.fraction()]))
}

pub(super) fn cases() -> Vec<Case> {
    let (turn, rate) = (In(0.1, TAU - 0.1), In(0.8, 1.5));
    let scene =
        |s: [Input; 3], beta: Input| [s[0], s[1], s[2], turn, beta, turn, rate, Signed(-3.0, -0.5), rate, In(1.0, 1.2)];
    let small = [Signed(-8.0, -3.0), Signed(-8.0, -3.0), Signed(-8.0, -3.0)];
    let two = [Log(-5.0, 0.0), Log(-5.0, 0.0), In(0.1, 1.0), In(0.1, 1.0)];
    vec![
        Multipoles::case("sphere, e -> 0: rounding of the quadrature of degree 4", &[Log(-8.0, -0.1)])
            .except(
                1e15,
                "C of nearly a sphere is what is left of integrals over the whole star: condition number \
e^-2. `UniformSpheroid::c` is regular.",
            )
            .derivatives_except(1e15, "As for the value.")
            .with_points(2),
        Case::of_doubles::<Asked>(
            "states_with_integrals, TorusStates::components",
            "s -> 0, energy, spin and K of the state found",
            &scene(small, In(0.3, 1.2)),
            states,
        )
        .composite()
        .vector(),
        Case::of_doubles::<AskedOfSeparatrix>(
            "separatrix_motion",
            "s -> 0, energy and spin of the state found",
            &scene([Signed(-8.0, -4.0), Fixed(0.01), Fixed(-0.01)], In(0.3, 1.2)),
            separatrix,
        )
        .composite()
        .vector(),
        Case::of_doubles::<OfSymmetric>(
            "torus_frequencies",
            "s -> 0, against the exact motion for a symmetric tensor",
            &[Signed(-6.0, -1.5), In(0.6, 1.0), In(1.05, 1.2), Signed(-3.0, -1.5), Signed(-3.0, -1.5)],
            frequencies,
        )
        .composite()
        .vector()
        .with_points(4),
        Case::of_doubles::<Probability>(
            "EtaDistribution: from_speeds, quantile, probability_above",
            "probability -> 0 and 1",
            &[&[In(0.001, 0.999)], &two[..]].concat(),
            probability,
        ),
        Case::of_doubles::<RootMeanSquare>(
            "EtaDistribution::root_mean_square",
            "speeds -> 0",
            &[&[Fixed(0.5)], &two[..]].concat(),
            root_mean_square,
        ),
        Case::of_doubles::<Seconds>(
            "Epoch: after, seconds_since",
            "from 1 day to 27,000 years and back",
            &[Log(4.95, 11.5), Fixed(0.0)],
            seconds,
        ),
        Case::of_doubles::<Fraction>(
            "Epoch: new, after, day, fraction",
            "a time from 1e-12 s to 1e11 s",
            &[Signed(-12.0, 9.0), In(0.0, 0.999)],
            fraction,
        )
        .unit(),
    ]
}
