//! Many motions side by side.

use twofold::propagation::{SampledProblem, Samples, states_of_many};

use crate::physical_domain::drawn;
use crate::prelude::*;

const SEED: u8 = 31;
const COUNT: usize = 90;

/// Sample times of one motion: in one to four intervals, every third motion backwards, some times twice or at the start.
fn times(i: usize) -> Vec<f64> {
    let sign = if i.is_multiple_of(3) { -1.0 } else { 1.0 };
    let mut times: Vec<_> = (0..1 + i % 4).map(|k| 0.5 + sign * (3.0 + 11.3 * k as f64 + 0.37 * i as f64)).collect();
    if i.is_multiple_of(5) {
        times.insert(0, times[0]);
    }
    if i.is_multiple_of(7) {
        times.insert(0, 0.5);
    }
    times
}

/// Random motions at tolerances from 1e-3 to 1e-14, among them one without times and one at a bad tolerance.
fn motions<'t>(scenes: &[RandomScene], times: &'t [Vec<f64>]) -> Vec<SampledProblem<'t>> {
    let motion = |(i, (scene, times)): (usize, (&RandomScene, &'t Vec<f64>))| SampledProblem {
        problem: scene.problem().reduced(),
        start: 0.5,
        times: if i == 29 { &[] } else { times },
        tolerance: if i == 41 { 1.0 } else { 10f64.powi(-3 - (i % 12) as i32) },
    };
    scenes.iter().zip(times).enumerate().map(motion).collect()
}

type Found = Result<Samples<AxisState<f64>>, twofold::Error>;

fn same(a: &Found, b: &Found) -> bool {
    match (a, b) {
        (Ok(a), Ok(b)) => {
            let bits = |s: &AxisState<f64>| [s.axis, s.momentum].map(|v| [v.x, v.y, v.z].map(f64::to_bits));
            a.step_count == b.step_count && a.states.iter().map(bits).eq(b.states.iter().map(bits))
        }
        (Err(a), Err(b)) => a.to_string() == b.to_string(),
        _ => false,
    }
}

/// Number of motions that change if computed alone, in reversed order, or with every third one.
pub(super) fn neighbours() -> Result<Measured, String> {
    let (scenes, times) = (drawn(SEED, COUNT, &scenes())?, (0..COUNT).map(times).collect::<Vec<_>>());
    let all = motions(&scenes, &times);
    let whole = states_of_many(&all);
    let everyone: Vec<usize> = (0..COUNT).collect();
    let mut parts: Vec<Vec<usize>> = everyone.iter().map(|&i| vec![i]).collect();
    parts.push(everyone.iter().rev().copied().collect());
    parts.extend((0..3).map(|k| everyone.iter().copied().filter(|i| i % 3 == k).collect()));
    let mut different = 0;
    for part in parts {
        let some: Vec<_> = part.iter().map(|&i| all[i]).collect();
        let found = states_of_many(&some);
        different += part.iter().zip(&found).filter(|(i, found)| !same(&whole[**i], found)).count();
    }
    Ok(Measured::new(f64::from(different as u32), format!("{COUNT} motions of seed {SEED}")))
}

/// The largest difference from the Taylor motion over the tolerance plus that motion's estimate. It is an error if only one of
/// the two is refused.
pub(super) fn tolerance() -> Result<Measured, String> {
    let (scenes, times) = (drawn(SEED, COUNT, &scenes())?, (0..COUNT).map(times).collect::<Vec<_>>());
    let all = motions(&scenes, &times);
    let found = states_of_many(&all);
    worst_of(0..COUNT, |&i| {
        let SampledProblem { problem, start, times, tolerance } = &all[i];
        let finest = if *tolerance < 0.1 { 1e-15 } else { *tolerance };
        let truth = problem.taylor_states(*start, times, finest);
        let (found, truth) = match (&found[i], truth) {
            (Err(ours), Err(theirs)) if ours.to_string() == theirs.to_string() => return Ok(None),
            (found, truth) => (found.as_ref().map_err(ToString::to_string)?, truth?),
        };
        if found.states.len() != times.len() {
            return Err(format!("{} states of motion {i}", found.states.len()));
        }
        let unit = problem.initial().momentum.norm().max(1.0);
        let kept = problem.taylor((*start, times[times.len() - 1]), finest)?;
        let apart = found.states.iter().zip(&truth.states).zip(*times);
        let over = |a, b, t| largest_difference(a, b, unit) / (tolerance + kept.error_estimate(t));
        largest_if_any(apart.map(|((a, b), t)| Ok(over(a, b, *t))))
    })
}
