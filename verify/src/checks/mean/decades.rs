//! Phases of the averaged motion over decades.

use nalgebra::Vector3;
use twofold::Scalar;
use twofold::dynamics::BodyState;
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::propagation::{AveragedMotion, Motion};
use twofold::solutions::averaged::{AveragedSolution, AveragingOrder};

use super::scenes::{difference, random_state};
use crate::check::{Bound, Check, Kind, Measured, Worst, largest};
use crate::double_double::DoubleDouble;
use crate::random::Random;

/// Checks of this subject.
pub(super) fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "mean-phase-decades",
            kind: Kind::Oracle,
            equations: &[25, 48],
            statement: "the phases about L and about n after 4e11 turns (20 years at 642 Hz) are those of the same theory in double-double numbers, for s below 1e-6",
            figure: "largest difference (turns), 40 random motions, both orders",
            bound: Bound::AtMost(1e-9),
            reason: "asked of them: 1 ns in 20 years is 6e-7 turn; what Lorentz violation adds is known to 1e-16 of its 1e-6 of the turns",
            measure: phases,
        },
        Check {
            id: "mean-epochs",
            kind: Kind::Property,
            equations: &[25],
            statement: "the motion near an epoch after up to 1e15 turns is that motion: the same state from the time zero, in two parts, and from the epoch",
            figure: "largest difference of a component, 200 random motions, epochs from 1 to 1e15",
            bound: Bound::AtMost(4e-14),
            reason: "a phase rounded to 1e-16 turn at the epoch, and some hundred roundings of a state each",
            measure: epochs,
        },
    ]
}

fn phases() -> Result<Measured, String> {
    let mut random = Random::with_seed(62);
    let mut worst = Worst::default();
    let lift = |v: &Vector3<f64>| v.map(DoubleDouble::from_f64);
    for case in 0..40 {
        let state = random_state(&mut random);
        let size = 10f64.powf(random.within(-15.0, -6.0));
        let s = state.s * size;
        let order = if case % 2 == 0 { AveragingOrder::First } else { AveragingOrder::Second };
        let across = state.n.cross(&Vector3::new(0.3, -0.5, 0.8)).normalize();
        let initial = BodyState { axis: state.n, momentum: state.momentum, equatorial_axis: across };
        let mean = AveragedSolution::new(&state.body, &PrincipalCoefficients::new(s.into()), &initial, order)?;
        let exact = AveragedSolution::new(
            &state.body.map(DoubleDouble::from_f64),
            &PrincipalCoefficients::new(lift(&s).into()),
            &BodyState { axis: lift(&state.n), momentum: lift(&state.momentum), equatorial_axis: lift(&across) },
            order,
        )?;
        let turns = 4e11;
        let time = [turns / mean.rates().about_momentum * core::f64::consts::TAU, 1e-9 * random.within(-1.0, 1.0)];
        let found = mean.turns(time);
        let tau = DoubleDouble::tau();
        let time = DoubleDouble::sum_of(time[0], time[1]);
        let rates = exact.rates();
        for (name, turns, rate) in
            [("L", found.about_momentum, rates.about_momentum), ("n", found.about_axis, rates.about_axis)]
        {
            let right = rate * time / tau;
            let off = right - DoubleDouble::from_f64(turns.whole as f64) - DoubleDouble::from_f64(turns.fraction);
            let off = off.high() - off.high().round();
            worst.see(off.abs(), || format!("case {case} of seed 62 about {name}: {:?} of {turns:?}", order));
        }
    }
    worst.finish()
}

fn epochs() -> Result<Measured, String> {
    let mut random = Random::with_seed(63);
    let mut worst = Worst::default();
    for case in 0..200 {
        let state = random_state(&mut random);
        let s = nalgebra::Matrix3::from_diagonal(&(state.s * 10f64.powf(random.within(-15.0, -3.0))));
        let across = state.n.cross(&Vector3::new(0.3, -0.5, 0.8)).normalize();
        let initial = BodyState { axis: state.n, momentum: state.momentum, equatorial_axis: across };
        let motion = AveragedMotion::from_parts(&state.body, &s, &initial, (0.0, 1e17), AveragingOrder::Second)?;
        let epoch = 10f64.powf(random.within(0.0, 15.0));
        let epoch = [epoch, epoch * f64::EPSILON * random.within(-0.4, 0.4)];
        let later = random.within(0.0, 1e-3) * epoch[0].min(100.0);
        let near = motion.near(epoch)?.state(later)?;
        let time = twofold_sum(epoch, later);
        let from_start = motion.state_in_parts(time)?;
        worst.see(largest([difference(&near, &from_start)]), || format!("case {case} of seed 63, epoch {epoch:?}"));
    }
    worst.finish()
}

/// `a[0] + a[1] + b` as a sum of two doubles.
fn twofold_sum(a: [f64; 2], b: f64) -> [f64; 2] {
    let sum = DoubleDouble::sum_of(a[0], a[1]) + DoubleDouble::from_f64(b);
    [sum.high(), sum.low()]
}
