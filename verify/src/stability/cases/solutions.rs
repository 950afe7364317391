//! Free rotation, steady precession, perturbation solutions.

use twofold::solutions::free::rotated_by;
use twofold::solutions::perturbation::constants_from_initial_values;

use super::parts::*;

fn axis_angles<S: Real>(q: &AxisAngles<S>) -> Vec<S> {
    vec![q.alpha, q.beta, q.alpha_rate, q.beta_rate]
}

fn constants<S: Real>(x: &[S]) -> Constants<S> {
    Constants { alpha_0: x[0], beta_0: x[1], amplitude: x[2], phase: x[3] }
}

/// `s^ZZ`, `s^XX = s^YY`, spin, `beta`, body.
fn steady<S: Real>(kind: Precession, x: &[S]) -> Vec<S> {
    let s = PrincipalCoefficients { xx: x[1], yy: x[1], zz: x[0] };
    steady_precession_rate(kind, &body(&x[4..]), &s, x[2], x[3]).map_or(none(1), |rate| vec![rate])
}

/// Constants (4), `s` (3), spin, time, body.
fn perturbation<S: Real>(form: Form, kind: Precession, x: &[S]) -> Option<Perturbation<S>> {
    Perturbation::new(form, kind, &body(&x[9..]), &principal(&x[4..]), x[7], &constants(x)).ok()
}

fn all_of<S: Real>(solution: Option<Perturbation<S>>, t: S) -> Vec<S> {
    solution.map_or(none(11), |p| {
        let mut all = vec![p.omega, p.rate, p.forced_rate, p.c_tilde, p.eta_alpha, p.eta_beta, p.homogeneous_ratio];
        all.extend(axis_angles(&p.at(t)));
        all
    })
}

functions! {
    SteadyTwofold: "steady_precession_rate", (x) { steady(Precession::Twofold, x) }
    SteadySingle: "steady_precession_rate", (x) { steady(Precession::Single, x) }
    /// Eq. (26) as printed, lower sign.
    PrintedSingle(x) {
        let (_, cb) = x[3].sin_cos();
        let (inertia, momentum) = (x[4], x[5] * x[2]);
        let root = (momentum * momentum - (x[0] - x[1]) * x[6] * inertia * cb * cb * 8.0).sqrt();
        vec![(if momentum.re() < 0.0 { momentum + root } else { momentum - root }) / (inertia * cb * 2.0)]
    }
    FreeRates: "free_precession_rates", (x) {
        free_precession_rates(&body(&x[2..]), x[1], x[0]).map_or(none(3), |rates| of_rates(&rates))
    }
    // t, n, L, e_x, body
    FreeRotation: "free_rotation".against::<ExactFreeRotation>().composite().vector(), (x) {
        let state = state(&x[1..]);
        let after = free_rotation(&body(&x[10..]), &state, x[0]);
        of_state(&after)
    }
    ExactFreeRotation(x) {
        let (spheroid, t) = (body(&x[10..]), x[0]);
        let (n, momentum, e) = (vector(&x[1..]), vector(&x[4..]), vector(&x[7..]));
        let spin = momentum.dot(&n) / spheroid.inertia_zz;
        let (sin, cos) = (-(spheroid.oblateness() * spin * t)).sin_cos();
        let turned = e * cos + n.cross(&e) * sin;
        let turn = momentum * (t / spheroid.inertia_xx);
        joined(&[rotation(&turn, &n), momentum, rotation(&turn, &turned)])
    }
    Rotated: "rotated_by".against::<ExactRotated>().vector(), (x) {
        joined(&[rotated_by(&(vector(&x[1..]) * x[0]), &vector(&x[4..]))])
    }
    ExactRotated(x) { joined(&[rotation(&(vector(&x[1..]) * x[0]), &vector(&x[4..]))]) }
    /// With `1 - cos`.
    NaiveRotated(x) {
        let turn = vector(&x[1..]) * x[0];
        let v = vector(&x[4..]);
        let angle = turn.dot(&turn).sqrt();
        let (sin, cos) = angle.sin_cos();
        let across = turn.cross(&v);
        joined(&[v + across * (sin / angle) + turn.cross(&across) * ((S::one() - cos) / (angle * angle))])
    }
    Twofold(x) { all_of(perturbation(Form::Printed, Precession::Twofold, x), x[8]) }
    Single: "Perturbation: new, new_unchecked, at", (x) { all_of(perturbation(Form::Printed, Precession::Single, x), x[8]) }
    Corrected(x) { all_of(perturbation(Form::Corrected, Precession::Twofold, x), x[8]) }
    CorrectedSingle(x) { all_of(perturbation(Form::Corrected, Precession::Single, x), x[8]) }
    /// The same with `s^ZZ` first, then `s^XX`, `s^YY`, constants, spin, time, body.
    SingleByZ: "Perturbation: new, new_unchecked, at".composite(), (x) { Single::of(&by_z(x)) }
    TwofoldByZ: "Perturbation: new, new_unchecked, at".composite(), (x) { Twofold::of(&by_z(x)) }
    CorrectedByZ: "Perturbation: new, new_unchecked, at".composite(), (x) { Corrected::of(&by_z(x)) }
    CorrectedSingleByZ: "Perturbation: new, new_unchecked, at".composite(), (x) { CorrectedSingle::of(&by_z(x)) }
    SingleByTime: "Perturbation: new, new_unchecked, at", (x) { Single::of(&by_time(x)) }
    CorrectedByTime: "Perturbation: new, new_unchecked, at", (x) { Corrected::of(&by_time(x)) }
    Parts: "Perturbation::first_order, changes_from_start".composite(), (x) {
        perturbation(Form::Printed, Precession::Twofold, x).map_or(none(6), |p| {
            let (first, rates) = (p.first_order(x[8], x[0]), p.first_order_rates(x[8], x[0]));
            let change = changes_from_start(&p, x[8]);
            vec![first.0, first.1, rates.0, rates.1, change.0, change.1]
        })
    }
    Shifted: "shifted_rates", (x) {
        shifted_rates(&body(&x[5..]), &principal(&x[1..]), x[4], x[0]).map_or(none(2), |rates| vec![rates.alpha, rates.gamma])
    }
    // beta_0, s (3), spin, alpha_0, A, phi, body
    InitialValues: "Perturbation::at zero".composite(), (x) {
        let constants = Constants { alpha_0: x[5], beta_0: x[0], amplitude: x[6], phase: x[7] };
        Perturbation::new(Form::Printed, Precession::Twofold, &body(&x[8..]), &principal(&x[1..]), x[4], &constants)
            .map_or(none(4), |solution| axis_angles(&solution.at(S::zero())))
    }
    // s^ZZ, s^XX, s^YY, spin, alpha, beta, their rates, body
    ConstantsTwofold: "constants_from_initial_values", (x) { found_constants(Form::Printed, Precession::Twofold, x) }
    ConstantsSingle: "constants_from_initial_values", (x) { found_constants(Form::Printed, Precession::Single, x) }
    CorrectedConstantsTwofold: "constants_from_initial_values", (x) {
        found_constants(Form::Corrected, Precession::Twofold, x)
    }
    CorrectedConstantsSingle: "constants_from_initial_values", (x) { found_constants(Form::Corrected, Precession::Single, x) }
    // beta, alpha, spin, first-order motion (5), s, body
    Linearised: "printed_residuals, full_residuals".composite(), (x) {
        let zeroth = |kind| ZerothOrder { kind, spin: x[2], alpha: x[1], beta: x[0] };
        let first = FirstOrderMotion {
            beta: x[3], alpha_rate: x[4], beta_rate: x[5], alpha_acceleration: x[6], beta_acceleration: x[7],
        };
        let (spheroid, s) = (body(&x[11..]), principal(&x[8..]));
        let printed = printed_residuals(&spheroid, &s, &zeroth(Precession::Single), &first);
        let [twofold, single] =
            [Precession::Twofold, Precession::Single].map(|kind| full_residuals(&spheroid, &s, &zeroth(kind), &first));
        vec![printed.0, printed.1, twofold.0, twofold.1, single.0, single.1]
    }
}

fn by_z<S: Real>(x: &[S]) -> Vec<S> {
    [&x[3..7], &x[1..3], &x[..1], &x[7..]].concat()
}

fn by_time<S: Real>(x: &[S]) -> Vec<S> {
    [&x[1..9], &x[..1], &x[9..]].concat()
}

fn found_constants<S: Real>(form: Form, kind: Precession, x: &[S]) -> Vec<S> {
    let s = PrincipalCoefficients { xx: x[1], yy: x[2], zz: x[0] };
    let initial = AxisAngles { alpha: x[4], beta: x[5], alpha_rate: x[6], beta_rate: x[7] };
    constants_from_initial_values(form, kind, &body(&x[8..]), &s, x[3], &initial)
        .map_or(none(4), |found| vec![found.alpha_0, found.beta_0, found.amplitude, found.phase])
}

/// Rotation without a series for small angles.
fn rotation<S: Real>(turn: &Vector3<S>, v: &Vector3<S>) -> Vector3<S> {
    let square = turn.dot(turn);
    let angle = square.sqrt();
    let ((sin, _), (sin_half, _)) = (angle.sin_cos(), (angle / 2.0).sin_cos());
    let across = turn.cross(v);
    v + across * (sin / angle) + turn.cross(&across) * (sin_half * sin_half * 2.0 / square)
}

const PHASES: &str = "Two phases that grow together, each with a rounding of its own: where the slopes of their terms cancel, the scale does not see it, \
                      condition number t a over the rest.";
const BETA: Input = In(0.2, 1.4);
const SPIN: Input = In(0.5, 2.0);
const SMALL: Input = Signed(-6.0, -1.0);
const AMPLITUDE: Input = Signed(-9.0, -1.0);

pub(super) fn cases() -> Vec<Case> {
    let (i, c) = (INERTIA, COMPONENT);
    let mut cases = vec![
        SteadyTwofold::case(
            "s -> 0, twofold",
            &[Signed(-300.0, -2.5), Signed(-6.0, -2.5), SPIN, BETA, i, i, In(0.1, 0.5)],
        ),
        SteadySingle::case(
            "s -> 0, single",
            &[Signed(-300.0, -2.5), Signed(-6.0, -2.5), SPIN, BETA, i, i, In(0.1, 0.5)],
        )
        .beside::<PrintedSingle>("Eq. (26) as printed"),
        SteadySingle::case(
            "the two roots meet",
            &list![Below(0.125, -15.0, -3.0), Fixed(0.0), Fixed(1.0), Fixed(0.0), Fixed(1.0); 3],
        ),
        FreeRates::case("cos b -> 0", &[Near(FRAC_PI_2, -15.0, -0.5), SPIN, i, i, Fixed(1.0)]),
        Rotated::case("angle -> 0", &list![Log(-150.0, 0.0), c; 6]).beside::<NaiveRotated>("1 - cos"),
        Rotated::case("angle to 1e15", &list![Log(0.0, 15.0), c; 6]),
        FreeRotation::case("t from 1e-150 to 1e15", &list![Log(-150.0, 15.0), c; 9, i; 3]),
        Parts::case("alpha_0 -> 0", &list![Signed(-300.0, 0.5), BETA, AMPLITUDE, TURN, SMALL; 3, SPIN, TURN, i; 3]),
        Linearised::case("sin b -> 0", &list![Log(-15.0, 0.0), TURN, SPIN, c; 5, SMALL; 3, i; 3]),
        InitialValues::case("sin b -> 0", &list![Log(-15.0, 0.0), SMALL; 3, SPIN, TURN, AMPLITUDE, TURN, i; 3]),
        InitialValues::case(
            "cos b -> 0",
            &list![Near(FRAC_PI_2, -12.0, -0.5), SMALL; 3, SPIN, TURN, AMPLITUDE, TURN, i; 3],
        ),
        Shifted::case("cos b -> 0", &list![Near(FRAC_PI_2, -15.0, -0.5), SMALL; 3, SPIN, i; 3]),
        Shifted::case("sin b -> 0", &list![Near(PI, -15.0, -0.5), SMALL; 3, SPIN, i; 3]),
    ];
    let body = [AMPLITUDE, Fixed(1.0), In(1.0, 1.2), Fixed(1.0)];
    let constants_of = |s: [Input; 3], spread: Input| [&s[..], &[SPIN, TURN, In(0.4, 1.0), spread], &body].concat();
    let constants_twofold = constants_of([Signed(-300.0, -3.0), Signed(-6.0, -3.0), Signed(-6.0, -3.0)], In(1.4, 2.0));
    let constants_single = constants_of([In(0.01, 0.05), Fixed(0.02), Near(0.02, -15.0, -3.0)], Signed(-9.0, -2.0));
    cases.extend(
        [
            ConstantsTwofold::case("s -> 0, twofold", &constants_twofold),
            ConstantsSingle::case("asymmetry -> 0, single", &constants_single),
            CorrectedConstantsTwofold::case("s -> 0, corrected twofold", &constants_twofold),
            CorrectedConstantsSingle::case("asymmetry -> 0, corrected single", &constants_single),
        ]
        .map(|case| case.composite().with_points(10)),
    );
    // Constants, s, spin, time, body; by z: s^ZZ, s^XX, s^YY, constants, spin, time, body.
    let rest = [In(0.5, 3.0), BETA, AMPLITUDE, TURN, SPIN, TURN, i, i, i];
    let a1_vanishes = [&[Near(0.02, -15.0, -2.0), Fixed(0.01), Fixed(0.03)], &rest[..]].concat();
    let s_vanishes = [&[Signed(-300.0, -1.0), Signed(-300.0, -1.0), Signed(-300.0, -1.0)], &rest[..]].concat();
    let equal = [&[SMALL, Near(0.1, -15.0, -3.0), Fixed(0.1)], &rest[..]].concat();
    macro_rules! of_each_solution {
        ($limit:literal) => {
            [
                concat!($limit, ", twofold"),
                concat!($limit, ", single"),
                concat!($limit, ", corrected twofold"),
                concat!($limit, ", corrected single"),
            ]
        };
    }
    for (inputs, [twofold, single, corrected_twofold, corrected_single]) in [
        (&a1_vanishes, of_each_solution!("a^(1) -> 0")),
        (&s_vanishes, of_each_solution!("s -> 0")),
        (&equal, of_each_solution!("s^XX -> s^YY")),
    ] {
        cases.extend([
            TwofoldByZ::case(twofold, inputs),
            SingleByZ::case(single, inputs),
            CorrectedByZ::case(corrected_twofold, inputs),
            CorrectedSingleByZ::case(corrected_single, inputs),
        ]);
    }
    cases.push(
        Single::case(
            "alpha_0 -> 0 with s^XX alone",
            &list![Log(-6.0, -1.0), BETA, Fixed(0.0); 2, In(0.01, 0.1), Fixed(0.0); 2, SPIN, Fixed(0.0), i; 3],
        )
        .except(
            1e14,
            "`alpha = alpha_0 - (1/2) sin 2 alpha_0` for an asymmetry as large as the combination: a \
condition number of alpha_0^-2 of the sum of the mean angle and the first-order one, \
where that is no small part.",
        )
        .derivatives_except(1e14, "As for the value."),
    );
    let over_time = [Log(-3.0, 15.0), TURN, BETA, AMPLITUDE, TURN, SMALL, SMALL, SMALL, SPIN, i, i, i];
    cases.extend([
        SingleByTime::case("t to 1e15, single", &over_time).except(1e3, PHASES).derivatives_except(1e3, PHASES),
        CorrectedByTime::case("t to 1e15, corrected twofold", &over_time)
            .except(1e3, PHASES)
            .derivatives_except(1e3, PHASES),
    ]);
    cases
}
