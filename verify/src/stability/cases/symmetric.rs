//! The exact motion for a tensor symmetric about Z.

use super::parts::*;

/// `s^ZZ - s^XX`, beta, alpha, gamma, rates (3), body.
fn solution<S: Real>(x: &[S]) -> Option<SymmetricSolution<S>> {
    let zero = S::zero();
    let s = PrincipalCoefficients { xx: zero, yy: zero, zz: x[0] };
    SymmetricSolution::new(&body(&x[7..]), &s, &angles(&[x[2], x[1], x[3]]), &rates(&x[4..])).ok()
}

fn at<S: Real>(x: &[S], t: S) -> Vec<S> {
    solution(x).map_or(none(6), |motion| [of_angles(&motion.angles(t)), of_rates(&motion.rates(t))].concat())
}

fn whole<S: Real>(x: &[S]) -> Vec<S> {
    solution(x).map_or(none(5), |motion| {
        let (mean, (least, most)) = (motion.mean_rates(), motion.inclinations());
        vec![motion.period(), mean.alpha, mean.gamma, least, most]
    })
}

functions! {
    AtByS: "SymmetricSolution: new, angles, rates".composite(), (x) { at(x, S::one()) }
    WholeByS: "SymmetricSolution: period, mean_rates, inclinations".composite().vector(), (x) { whole(x) }
    AtByBeta: "SymmetricSolution: new, angles, rates".composite(), (x) {
        at(&[&x[1..2], &x[..1], &x[2..]].concat(), S::one())
    }
    AtByTime: "SymmetricSolution: new, angles, rates", (x) { at(&x[1..], x[0]) }
    AtBySpin: "SymmetricSolution: new, angles, rates".composite(), (x) {
        at(&[&x[1..6], &x[..1], &x[6..]].concat(), S::one())
    }
}

const POLE: &str =
    "By `beta` itself, which near `pi` has not the digits of its distance from there: condition number 1 / sin b.";
const BETA: Input = In(0.3, 1.2);
const RATE: Input = In(0.5, 1.5);

pub(super) fn cases() -> Vec<Case> {
    let (i, one) = (In(0.5, 2.0), Fixed(1.0));
    let scene = |s: Input| [s, BETA, TURN, TURN, RATE, Signed(-3.0, -0.3), RATE, one, i, one];
    let by_beta = |beta: Input| [beta, Signed(-6.0, -1.0), TURN, TURN, RATE, Signed(-3.0, -0.3), RATE, one, i, one];
    vec![
        AtByS::case("s -> 0", &scene(Signed(-300.0, -1.0))),
        WholeByS::case("s -> 0, relative to the rotation", &scene(Signed(-300.0, -1.0))),
        AtByS::case("s to 1", &scene(In(0.1, 1.0))),
        WholeByS::case("s to 1, relative to the rotation", &scene(In(0.1, 1.0))),
        AtByBeta::case("cos b -> 0", &by_beta(Near(FRAC_PI_2, -15.0, -0.5))),
        AtByBeta::case("sin b -> 0", &by_beta(Log(-6.0, -0.5))),
        AtByBeta::case("sin b -> 0 at beta = pi", &by_beta(Below(PI, -6.0, -0.5))),
        AtByTime::case(
            "t to 1e15",
            &[Log(-10.0, 15.0), Signed(-6.0, -1.0), BETA, TURN, TURN, RATE, Signed(-3.0, -0.3), RATE, one, i, one],
        )
        .except(
            64.0,
            "`alpha` and `gamma` are sums and differences of the turns about both poles, each a \
number of periods times a composite.",
        ),
        AtBySpin::case(
            "rate of beta -> 0, nearly steady",
            &[Signed(-12.0, 0.0), Signed(-6.0, -1.0), BETA, TURN, TURN, RATE, RATE, one, i, one],
        ),
    ]
    .into_iter()
    .map(|case| {
        let south = case.limit.ends_with("pi");
        let case = case.natural_derivatives();
        if south { case.derivatives_except(1e8, POLE) } else { case }
    })
    .collect()
}
