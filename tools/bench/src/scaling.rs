//! Cost against the number of outputs, of scenes and of cores.

use std::num::NonZero;
use std::thread;
use std::time::Instant;

use twofold::propagation::{Motion, SampledProblem, states_of_many};

use super::Effort;
use super::overhead::TOLERANCE;
use super::scene::{BenchScene, DURATION};
use super::timing::{Times, in_turn};

/// Time for a number of outputs, scenes or cores.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// What is counted: `outputs`, `scenes` or `cores`.
    pub of: &'static str,
    /// How many.
    pub count: usize,
    /// Least time of the whole (s).
    pub least: f64,
    /// Time of one output, or of one scene on all cores together (s).
    pub each: f64,
}

const OUTPUTS: [usize; 6] = [1, 10, 100, 1000, 10_000, 100_000];

const SCENES: [usize; 3] = [1, 10, 100];

/// Number of scenes that are spread over the cores.
const SPREAD: usize = 1600;

/// Number of scenes that a core computes together, as in a sweep.
const TOGETHER: usize = 16;

/// Measures all cases on tp-II and scenes near it; `done` receives the fraction of the work that is over.
pub fn measure(effort: &Effort, mut done: impl FnMut(f64)) -> Result<Vec<Row>, String> {
    let scene = BenchScene::named("tp-II");
    let mut outputs: Vec<_> = OUTPUTS.iter().map(|count| || sampled(&scene, *count)).collect();
    let times = in_turn(&mut outputs, effort.rounds.min(20), |part| done(part / 3.0))?;
    let row = |of| {
        move |(count, times): (&usize, Times)| Row {
            of,
            count: *count,
            least: times.least,
            each: times.least / *count as f64,
        }
    };
    let mut rows: Vec<_> = OUTPUTS.iter().zip(times).map(row("outputs")).collect();
    let mut scenes: Vec<_> = SCENES.iter().map(|count| || spread(&scene, *count, 1)).collect();
    let times = in_turn(&mut scenes, effort.rounds.div_ceil(10), |part| done((1.0 + part) / 3.0))?;
    rows.extend(SCENES.iter().zip(times).map(row("scenes")));

    let most = thread::available_parallelism().map_or(1, NonZero::get);
    let cores: Vec<_> = (1..=most).filter(|n| n.is_power_of_two() || *n == most).collect();
    let mut least = vec![f64::INFINITY; cores.len()];
    let rounds = effort.rounds.div_ceil(5);
    for round in 0..rounds {
        for (cores, least) in cores.iter().zip(&mut least) {
            // The gain from several cores shows only in wall-clock time.
            let clock = Instant::now();
            spread(&scene, SPREAD, *cores)?;
            *least = least.min(clock.elapsed().as_secs_f64());
        }
        done((2.0 + (round + 1) as f64 / rounds as f64) / 3.0);
    }
    rows.extend(cores.iter().zip(least).map(|(cores, least)| on_cores(*cores, least)));
    Ok(rows)
}

/// The row for all scenes, computed in the time `least` on `count` cores.
fn on_cores(count: usize, least: f64) -> Row {
    Row { of: "cores", count, least, each: least / SPREAD as f64 }
}

fn sampled(scene: &BenchScene, count: usize) -> Result<f64, String> {
    let span = (0.0, DURATION);
    let motion = scene.problem.reduced().taylor(span, TOLERANCE)?;
    (1..=count).try_fold(0.0, |sum, i| {
        let state = motion.state(DURATION * i as f64 / count as f64)?;
        Ok(sum + state.axis.z)
    })
}

/// The end states of `count` scenes, whose `s` differ a little, on a number of threads.
fn spread(scene: &BenchScene, count: usize, cores: usize) -> Result<f64, String> {
    let one = |i: usize| SampledProblem {
        problem: scene.beside(i, 1e-5),
        start: 0.0,
        times: &[DURATION],
        tolerance: TOLERANCE,
    };
    let some = |first: usize| {
        let scenes: Vec<_> = (first..count.min(first + TOGETHER)).map(one).collect();
        let ends = states_of_many(&scenes).into_iter();
        Ok(ends.map(|found| found.map(|found| found.states[0].axis.z)).sum::<Result<f64, twofold::Error>>()?)
    };
    let part = |core: usize| (core * TOGETHER..count).step_by(cores * TOGETHER).map(some).sum::<Result<f64, String>>();
    thread::scope(|scope| {
        let others: Vec<_> = (1..cores).map(|core| scope.spawn(move || part(core))).collect();
        let first = part(0)?;
        let joined = others.into_iter().map(|other| other.join().map_err(|_| "a thread panicked".to_owned())?);
        joined.sum::<Result<f64, _>>().map(|sum| first + sum)
    })
}

/// Time from nothing to the first state of a motion (s), the least of many: what a method costs before its first step.
pub fn set_up(effort: &Effort) -> Result<f64, String> {
    let scene = BenchScene::named("tp-II");
    let mut least = f64::INFINITY;
    for _ in 0..100 * effort.rounds {
        // The clock for the CPU time of the thread is too coarse for a microsecond.
        let clock = Instant::now();
        let motion = scene.problem.reduced().taylor((0.0, 1e-3), TOLERANCE)?;
        std::hint::black_box(motion);
        least = least.min(clock.elapsed().as_secs_f64());
    }
    Ok(least)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two cores do each of 33 scenes once, as one core does.
    #[test]
    fn each_core_has_scenes_of_its_own() {
        let scene = BenchScene::named("tp-II");
        let [one, two] = [1, 2].map(|cores| spread(&scene, 2 * TOGETHER + 1, cores).expect("motions"));
        // Scenes side by side may differ in the last digits from those alone.
        assert!((one - two).abs() < 1e-9 && one.abs() > 1e-3, "{one} {two}");
    }

    /// 1,600 scenes in 0.8 s are one in 0.5 ms, on however many cores.
    #[test]
    fn the_time_of_a_scene_is_that_on_the_wall() {
        assert_eq!([1, 2].map(|cores| on_cores(cores, 0.8).each), [5e-4; 2]);
    }
}
