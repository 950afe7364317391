//! Phases of the averaged motion over decades.

use super::scenes::{State, difference};
use crate::prelude::*;

checks! {
    /// the phases about L and about n after 4e11 turns (20 years at 642 Hz) are those of the same theory in double-double numbers, for s below 1e-6
    Oracle "mean-phase-decades" [25, 48]: phases;
    AtMost(1e-9) "largest difference (turns), 40 random motions, both orders";
    because "rounding of rates: what Lorentz violation adds, at most 1e-6 of 4e11 turns, is known to some 1e-16 of itself, 1e-10 turn; a bound of \
     1e-9 turn is 2 ps, far below 1 ns of timing";
    /// a state up to 1e15 t_c after the start is the same whether times count from the start, in two parts, or from near the state
    Property "mean-epochs" [25]: epochs;
    AtMost(4e-14) "largest difference of a component, 200 random motions that start from 1 to 1e15 t_c earlier";
    because "a phase rounded to 1e-16 turn, and some hundred roundings of a state each";
}

fn phases() -> Result<Measured, String> {
    let mut random = Random::with_seed(62);
    worst_of(0..40, |case| {
        let state = State::random(&mut random);
        let problem = state.problem(10f64.powf(random.within(-15.0, -6.0)))?;
        let order = if case % 2 == 0 { AveragingOrder::First } else { AveragingOrder::Second };
        let averaged = AveragedSolution::new(&problem, order)?;
        let rates = AveragedSolution::new(&problem.map(DoubleDouble::from_f64), order)?.rates();
        let turns = 4e11;
        let time = [turns / averaged.rates().about_momentum * TAU, 1e-9 * random.within(-1.0, 1.0)];
        let found = averaged.turns(time);
        let time = DoubleDouble::sum_of(time[0], time[1]);
        let off = [(found.about_momentum, rates.about_momentum), (found.about_axis, rates.about_axis)].map(
            |(turns, rate)| {
                let right = rate * time / DoubleDouble::tau();
                let off = right - DoubleDouble::from_f64(turns.whole as f64) - DoubleDouble::from_f64(turns.fraction);
                (off.high() - off.high().round()).abs()
            },
        );
        Ok(largest(off))
    })
}

fn epochs() -> Result<Measured, String> {
    worst_of_draws(63, 200, |random| {
        let state = State::random(random);
        let problem = state.problem(10f64.powf(random.within(-15.0, -3.0)))?;
        let motion = |span| AveragedMotion::new(&problem, span);
        let earlier = 10f64.powf(random.within(0.0, 15.0));
        let time = random.within(0.0, 1e-3) * earlier.min(100.0);
        let near = motion((-earlier, 1.0))?.state(time)?;
        let since_start = DoubleDouble::sum_of(earlier, time);
        Ok(difference(&near, &motion((0.0, 1e17))?.state_in_parts([since_start.high(), since_start.low()])?))
    })
}
