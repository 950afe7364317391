//! Carlson's integrals, Jacobi's functions, theta functions.

use twofold::numerics::elliptic::carlson::{rc, rd, rf, rf_of_roots, rj, rj_of_roots};
use twofold::numerics::elliptic::jacobi::{ArithmeticGeometricMean, JacobiFunctions, jacobi};
use twofold::numerics::elliptic::theta::{Nome, ThetaSeries};

use super::parts::*;

fn joined<S: Real>(f: JacobiFunctions<S>) -> Vec<S> {
    vec![f.sn, f.cn, f.dn]
}

/// Quarter period with `pi` to 32 digits.
fn quarter_period<S: Real>(m1: S) -> S {
    pi::<S>() / (ArithmeticGeometricMean::new(S::one(), m1.sqrt()).limit() * 2.0)
}

/// Roots of the pair `y`, `z`, conjugate where `im` is not zero: their sum and their product.
fn pair<S: Real>(re: S, im: S) -> (S, S) {
    let product = (re * re + im * im).sqrt();
    (((product + re) * 2.0).sqrt(), product)
}

functions! {
    Rf: "rf".against::<ExactRf>(), (x) { vec![rf(x[0], x[1], x[2])] }
    ExactRf(x) { vec![oracle::rf(x[0], x[1], x[2])] }
    Rc: "rc".against::<ExactRc>(), (x) { vec![rc(x[0], x[1])] }
    ExactRc(x) { vec![oracle::rc(x[0], x[1])] }
    /// By logarithm and arc tangent.
    NaiveRc(x) {
        let difference = x[1] - x[0];
        let root = difference.abs().sqrt();
        vec![if difference.re() > 0.0 {
            root.atan2(x[0].sqrt()) / root
        } else {
            ((x[0].sqrt() + root) / x[1].sqrt()).ln() / root
        }]
    }
    Rd: "rd".against::<ExactRd>(), (x) { vec![rd(x[0], x[1], x[2])] }
    ExactRd(x) { vec![oracle::rd(x[0], x[1], x[2])] }
    Rj: "rj".against::<ExactRj>(), (x) { vec![rj(x[0], x[1], x[2], x[3])] }
    ExactRj(x) { vec![oracle::rj(x[0], x[1], x[2], x[3])] }
    RfOfPair: "rf_of_roots".composite(), (x) {
        let (sum, product) = pair(x[1], x[0]);
        vec![rf_of_roots(x[2], sum, product)]
    }
    RjOfPair: "rj_of_roots".composite(), (x) {
        let (sum, product) = pair(x[1], x[0]);
        vec![rj_of_roots(x[2], sum, product, x[3])]
    }
    RfOfRoots: "rf_of_roots".composite(), (x) { vec![rf_of_roots(x[1], x[0], x[2])] }
    RjOfRoots: "rj_of_roots".composite(), (x) { vec![rj_of_roots(x[1], x[0], x[2], x[3])] }
    /// `u` in quarter periods, and the complementary parameter.
    Jacobi: "jacobi".against::<ExactJacobi>().composite().vector().natural_derivatives(), (x) {
        joined(jacobi(x[1], x[0]))
    }
    ExactJacobi(x) {
        let (m1, u) = (x[0], x[1]);
        let quarter = quarter_period(m1);
        let halves = (u.re() / (quarter.re() * 2.0)).round();
        let sign = if halves.rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
        let u = u - quarter * (halves * 2.0);
        let complement = m1.sqrt();
        let ladder = ArithmeticGeometricMean::new(S::one(), complement);
        let f = if u.re().abs() <= 0.5 * quarter.re() {
            ladder.functions(u)
        } else {
            let side = if u.re() < 0.0 { -1.0 } else { 1.0 };
            let f = ladder.functions(quarter - u * side);
            JacobiFunctions { sn: f.cn / f.dn * side, cn: complement * f.sn / f.dn, dn: complement / f.dn }
        };
        vec![f.sn * sign, f.cn * sign, f.dn]
    }
    JacobiOfLargeArgument: "jacobi".against::<ExactJacobiOfLargeArgument>().vector(), (x) { joined(jacobi(x[0], x[1])) }
    ExactJacobiOfLargeArgument(x) { ExactJacobi::of(&[x[1], x[0]]) }
    CompleteIntegral: "complete_integral".against::<ExactCompleteIntegral>(), (x) { vec![complete_integral(x[0])] }
    ExactCompleteIntegral(x) { vec![quarter_period(x[0])] }
    Functions: "ArithmeticGeometricMean: new, limit, functions".vector(), (x) {
        let ladder = ArithmeticGeometricMean::new(x[0], x[1]);
        let quarter = S::from_f64(FRAC_PI_2) / ladder.limit();
        let at = ladder.functions(quarter * x[2]);
        vec![ladder.limit(), at.sn, at.cn, at.dn]
    }
    OfNome: "Nome::new".against::<ExactOfNome>(), (x) {
        let nome = Nome::new(x[0], S::one() - x[0]);
        vec![nome.q, nome.q_over_m]
    }
    ExactOfNome(x) {
        let (k, complement) = (x[0].sqrt(), (S::one() - x[0]).sqrt());
        let mean = |b: S| ArithmeticGeometricMean::new(S::one(), b).limit();
        let q = (-(pi::<S>() * mean(complement) / mean(k))).exp();
        vec![q, q / x[0]]
    }
    NomeNearOne: "Nome::new".against::<ExactNomeNearOne>(), (x) {
        let nome = Nome::new(S::one() - x[0], x[0]);
        vec![nome.q, nome.q_over_m]
    }
    ExactNomeNearOne(x) {
        let (k, complement) = ((S::one() - x[0]).sqrt(), x[0].sqrt());
        let mean = |b: S| ArithmeticGeometricMean::new(S::one(), b).limit();
        let q = (-(pi::<S>() * mean(complement) / mean(k))).exp();
        vec![q, q / (S::one() - x[0])]
    }
    /// `q`, `r / q` as a power of `q`, sine and cosine.
    /// Decay, share of the shift, sine of the argument.
    ThetaOfDecay: "ThetaSeries: new, transformed, at"
        .composite().against::<ExactThetaOfDecay>().natural_derivatives(), (x) {
        let series = ThetaSeries::transformed(x[0], x[1] * FRAC_PI_2);
        let at = series.at(x[2], (S::one() - x[2] * x[2]).sqrt());
        let [along, across] = at.shifted;
        let size = (along * along + across * across).sqrt();
        vec![at.sn, at.cn, at.dn, at.slope, along / size, across / size]
    }
    ExactThetaOfDecay(x) {
        let mut all = ExactTheta::of(&[(-x[0]).exp(), x[1], x[2]]);
        all.extend(ExactThetaShifted::of(&[(-x[0]).exp(), x[1], x[2]]));
        all
    }
    Theta: "ThetaSeries: new, transformed, at".composite().vector(), (x) {
        let r = (x[0].ln() * x[1]).exp();
        let series = ThetaSeries::new(x[0], r, x[0] / r);
        let at = series.at(x[2], (S::one() - x[2] * x[2]).sqrt());
        vec![at.sn, at.cn, at.dn]
    }
    ThetaShifted: "ThetaSeries: new, transformed, at".composite().natural_derivatives(), (x) {
        let r = (x[0].ln() * x[1]).exp();
        let series = ThetaSeries::new(x[0], r, x[0] / r);
        let at = series.at(x[2], (S::one() - x[2] * x[2]).sqrt());
        let [along, across] = at.shifted;
        let size = (along * along + across * across).sqrt();
        vec![at.slope, along / size, across / size]
    }
    ExactTheta(x) {
        let [_, one, two, three, four] = theta_sums(x[0], x[2]);
        let [_, _, two_zero, three_zero, four_zero] = theta_sums(x[0], S::zero());
        vec![three_zero * one / (two_zero * four), four_zero * two / (two_zero * four), four_zero * three / (three_zero * four)]
    }
    ExactThetaShifted(x) {
        let [slope, _, _, _, four] = theta_sums(x[0], x[2]);
        let [along, across] = shifted_sums(x[0], x[1], x[2]);
        let size = (along * along + across * across).sqrt();
        vec![slope / four, along / size, across / size]
    }
}

/// The derivative of `theta_4`, and `theta_1`, ..., `theta_4` (DLMF 20.2.1 to 20.2.4) from the sine of the argument; enough terms for `q < 0.9`.
fn theta_sums<S: Real>(q: S, sin: S) -> [S; 5] {
    let z = sin.atan2((S::one() - sin * sin).sqrt());
    let [mut slope, mut one, mut two] = [S::zero(); 3];
    let [mut three, mut four] = [S::one(); 2];
    let log = q.ln();
    for n in 0..40 {
        let (sign, odd) = (if n % 2 == 0 { 2.0 } else { -2.0 }, f64::from(2 * n + 1));
        let term = (log * (odd * odd / 4.0)).exp();
        let (sin_odd, cos_odd) = (z * odd).sin_cos();
        one += term * sin_odd * sign;
        two += term * cos_odd * 2.0;
        if n > 0 {
            let term = (log * f64::from(n * n)).exp();
            let (sin_even, cos_even) = (z * f64::from(2 * n)).sin_cos();
            three += term * cos_even * 2.0;
            four += term * cos_even * sign;
            slope -= term * sin_even * (sign * f64::from(2 * n));
        }
    }
    [slope, one, two, three, four]
}

/// Real and imaginary part of `i theta_1(z + i eta)` with `exp(-2 eta) = q^share`.
fn shifted_sums<S: Real>(q: S, share: S, sin: S) -> [S; 2] {
    let z = sin.atan2((S::one() - sin * sin).sqrt());
    let [mut along, mut across] = [S::zero(); 2];
    let log = q.ln();
    for n in 0..40 {
        let (sign, odd) = (if n % 2 == 0 { 1.0 } else { -1.0 }, f64::from(2 * n + 1));
        // 2 q^((n+1/2)^2) cosh and sinh of (2n+1) eta, eta = -ln(q) share / 2.
        let term = log * (odd * odd / 4.0);
        let eta = log * share * (-0.5 * odd);
        let (up, down) = ((term + eta).exp(), (term - eta).exp());
        let (sin_odd, cos_odd) = (z * odd).sin_cos();
        // i sin(x + i y) = -cos x sinh y + i sin x cosh y
        along -= cos_odd * (up - down) * sign;
        across += sin_odd * (up + down) * sign;
    }
    [along, across]
}

pub(super) fn cases() -> Vec<Case> {
    let some = In(0.5, 2.0);
    let separatrix = [Below(0.88, -2.0, -0.25), In(0.1, 0.9), In(-1.0, 1.0)];
    let by_decay = [In(0.12, 1.5), In(0.1, 0.9), In(-1.0, 1.0)];
    let change = [In(0.25, 0.35), In(0.1, 0.9), In(-1.0, 1.0)];
    vec![
        Rf::case("one argument -> 0", &[Log(-300.0, 0.0), some, some]),
        Rf::case("one argument -> infinity", &[Log(0.0, 70.0), some, some]),
        Rf::case("equal arguments", &[Near(1.0, -15.0, -0.1), Near(1.0, -15.0, -0.1), Fixed(1.0)]),
        Rc::case("x -> 0", &[Log(-300.0, 0.0), some]),
        Rc::case("y -> 0", &[some, Log(-140.0, 0.0)]),
        Rc::case("equal arguments", &[Near(1.0, -15.0, -0.1), Fixed(1.0)])
            .beside::<NaiveRc>("arc tangent or logarithm"),
        Rd::case("x -> 0", &[Log(-300.0, 0.0), some, some]),
        Rd::case("z -> 0", &[some, some, Log(-90.0, 0.0)]),
        Rd::case("equal arguments", &[Near(1.0, -15.0, -0.1), Near(1.0, -15.0, -0.1), Fixed(1.0)]),
        Rj::case("x -> 0", &[Log(-300.0, 0.0), some, some, some]),
        Rj::case("p -> 0", &[some, some, some, Log(-60.0, 0.0)]),
        Rj::case(
            "equal arguments",
            &[Near(1.0, -15.0, -0.1), Near(1.0, -15.0, -0.1), Fixed(1.0), Near(1.0, -15.0, -0.1)],
        ),
        RfOfPair::case("conjugate pair that meets", &[Log(-15.0, 1.0), some, some]),
        RjOfPair::case("conjugate pair that meets", &[Log(-15.0, 1.0), some, some, some]),
        RfOfRoots::case("conjugate pair -> negative", &[Log(-100.0, 0.0), some, some]),
        RjOfRoots::case("conjugate pair -> negative", &[Log(-100.0, 0.0), some, some, some]),
        Jacobi::case("m -> 1", &[Log(-300.0, 0.0), In(-2.0, 2.0)]),
        Jacobi::case("m -> 0, both signs", &[Near(1.0, -15.5, -0.1), In(-10.0, 10.0)]),
        Jacobi::case("negative parameter to -1e10", &[Above(1.0, -3.0, 10.0), In(-1e-4, 1e-4)]),
        JacobiOfLargeArgument::case("u to 1e15", &[Signed(-300.0, 15.0), In(0.05, 3.0)]),
        CompleteIntegral::case("m -> 1", &[Log(-300.0, 0.0)]),
        CompleteIntegral::case("m -> -infinity", &[Log(0.0, 300.0)]),
        Functions::case("b / a -> 0", &[some, Log(-300.0, 0.0), In(-0.5, 0.5)]),
        OfNome::case("m -> 0", &[Log(-11.0, -0.4)]),
        OfNome::case("m -> 0, values", &[Log(-300.0, -0.4)]).values_only(),
        NomeNearOne::case("m -> 1", &[Log(-32.0, -0.4)]),
        Theta::case("q -> 0", &[Log(-100.0, -1.0), In(0.1, 0.9), In(-1.0, 1.0)]).derivatives_except(
            1e3,
            "They are 4 sin z cos z times cosine and sine of z, made of terms of the size 4: \
condition number 1 / sin z.",
        ),
        ThetaShifted::case("q -> 0, zeta and shifted", &[Log(-100.0, -1.0), In(0.1, 0.9), In(-1.0, 1.0)]),
        ThetaOfDecay::case("-ln q from 0.12 to 1.5", &by_decay),
        Theta::case("q from 0.25 to 0.35, where the series change", &change)
            .against::<ExactTheta>()
            .natural_derivatives(),
        ThetaShifted::case("q from 0.25 to 0.35, zeta and shifted", &change).against::<ExactThetaShifted>(),
        Theta::case("q -> 0.87, the separatrix", &separatrix).against::<ExactTheta>().natural_derivatives(),
        ThetaShifted::case("q -> 0.87, zeta and shifted", &separatrix)
            .against::<ExactThetaShifted>()
            .derivatives_except(
                100.0,
                "Here `r` is a power of `q`, and both carry their derivatives through `ln q`: condition \
number 1 / |ln q|. `transformed` does not.",
            ),
    ]
}
