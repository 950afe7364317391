//! States on tori and their exact frequencies.

use twofold::observables::spectrum::QuasiPeriodicMotion;
use twofold::solutions::torus::separatrix_motion;

use super::parts::*;

fn wide(x: f64) -> Wide {
    <Wide as twofold::Scalar>::from_f64(x)
}

functions! {
    // Energy, spin and K of the state with these angles and rates, as requested.
    Asked(x) {
        let (spheroid, s, state) = scene(x);
        integrals(&spheroid, &s, &state)
    }
    AskedOfSeparatrix(x) { Asked::of(x)[..2].to_vec() }
    OfSymmetric(x) {
        let (spheroid, s, angles, rates) = twofold(x);
        SymmetricSolution::new(&spheroid, &s, &angles, &rates).map_or(none(2), |motion| {
            let mean = motion.mean_rates();
            vec![mean.alpha, mean.gamma]
        })
    }
}

fn integrals<S: Real>(spheroid: &RigidSpheroid<S>, s: &PrincipalCoefficients<S>, state: &BodyState<S>) -> Vec<S> {
    let all = first_integrals(spheroid, &s.tensor(), state);
    vec![all.energy, all.spin, all.clebsch]
}

type Scene<S> = (RigidSpheroid<S>, PrincipalCoefficients<S>, BodyState<S>);

/// `s` (ZZ, XX, YY), angles, rates, `I^zz`.
fn scene<S: Real>(x: &[S]) -> Scene<S> {
    let spheroid = body(&[S::one(), x[9], S::one()]);
    let s = PrincipalCoefficients { xx: x[1], yy: x[2], zz: x[0] };
    let state = BodyState::from_angles(&spheroid, &angles(&x[3..]), &rates(&x[6..]));
    (spheroid, s, state)
}

type Twofold<S> = (RigidSpheroid<S>, PrincipalCoefficients<S>, EulerAngles<S>, EulerRates<S>);

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
    integrals(&spheroid, &s, &state).iter().map(|value| value.high()).collect()
}

fn rounded(x: &[f64]) -> FirstIntegrals<f64> {
    let wide: Vec<Wide> = x.iter().map(|&x| wide(x)).collect();
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
    Problem::new(spheroid, s.tensor(), state)
        .and_then(|problem| QuasiPeriodicMotion::new(&problem))
        .map_or(none(2), |motion| {
            ["alpha'", "gamma'"].map(|of| motion.frequencies().rate(of).unwrap_or(f64::NAN)).to_vec()
        })
}

pub(super) fn cases() -> Vec<Case> {
    let (turn, rate) = (In(0.1, TAU - 0.1), In(0.8, 1.5));
    let scene =
        |s: [Input; 3], beta: Input| [s[0], s[1], s[2], turn, beta, turn, rate, Signed(-3.0, -0.5), rate, In(1.0, 1.2)];
    let small = [Signed(-8.0, -3.0), Signed(-8.0, -3.0), Signed(-8.0, -3.0)];
    vec![
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
            "QuasiPeriodicMotion::frequencies",
            "s -> 0, against the exact motion for a symmetric tensor",
            &[Signed(-6.0, -1.5), In(0.6, 1.0), In(1.05, 1.2), Signed(-3.0, -1.5), Signed(-3.0, -1.5)],
            frequencies,
        )
        .composite()
        .vector()
        .with_points(4),
    ]
}
