//! Time against error, for every scene and method.

use super::Effort;
use super::method::{BASELINE, Carries, METHODS};
use super::scene::{BenchScene, DURATION};
use super::timing::{Times, in_turn};

/// One run of one method on one scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Name of the scene.
    pub scene: String,
    /// Name of the method.
    pub method: String,
    /// The vectors that the method computes.
    pub carries: Carries,
    /// Tolerance or step.
    pub setting: f64,
    /// Largest error of a component of `n`, `L / |L|` and, where it is carried, `e_x` at the end.
    pub error: f64,
    /// Run times.
    pub times: Times,
    /// Number of steps.
    pub steps: usize,
    /// Right-hand sides, coefficients of series, or rotations and kicks.
    pub evaluations: usize,
}

/// Errors at which methods are compared.
pub const ERRORS: [f64; 8] = [1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12];

/// Runs all methods on all scenes to [`DURATION`]; `done` receives the fraction of the work that is over.
pub fn measure(effort: &Effort, mut done: impl FnMut(f64)) -> Result<Vec<Row>, String> {
    let scenes = BenchScene::all();
    let mut rows = Vec::new();
    for (i, scene) in scenes.iter().enumerate() {
        let chosen: Vec<_> =
            METHODS.iter().flat_map(|method| method.settings.iter().map(move |s| (method, *s))).collect();
        let run = |&(method, setting): &(&super::method::Method, f64)| {
            (method.run)(scene, DURATION, setting)
                .map_err(|error| format!("{} of {} at {setting:e}: {error}", method.name, scene.name))
        };
        let mut cases: Vec<_> = chosen.iter().map(|case| move || run(case)).collect();
        let times = in_turn(&mut cases, effort.rounds, |part| done((i as f64 + part) / scenes.len() as f64))?;
        for (case @ (method, setting), times) in chosen.iter().zip(times) {
            let end = run(case)?;
            rows.push(Row {
                scene: scene.name.clone(),
                method: method.name.to_owned(),
                carries: method.carries,
                setting: *setting,
                error: scene.error(DURATION, &end),
                times,
                steps: end.steps,
                evaluations: end.evaluations,
            });
        }
    }
    Ok(rows)
}

/// Least time (s) at which a method reaches an error: on a straight line, in logarithms, between the cheapest runs on either
/// side of it. None for an error that the method does not reach; for one above all its errors, the time of its cheapest run.
pub fn time_at(rows: &[Row], scene: &str, method: &str, carries: Carries, error: f64) -> Option<f64> {
    let of_this = |row: &&Row| row.scene == scene && row.method == method && row.carries == carries;
    let front = front(rows.iter().filter(of_this).map(|row| (row.error, row.times.least)));
    let after = front.iter().position(|(e, _)| *e <= error)?;
    let (e1, t1) = front[after];
    let Some((e0, t0)) = after.checked_sub(1).map(|before| front[before]) else {
        // No setting is coarser than the coarsest, so its time is what the method takes.
        return Some(t1);
    };
    let part = (e0 / error).ln() / (e0 / e1).ln();
    Some(t0 * (t1 / t0).powf(part))
}

/// The runs that no other one beats in both error and time, from large errors to small ones.
pub fn front(runs: impl IntoIterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut runs: Vec<_> = runs.into_iter().filter(|(error, time)| error.is_finite() && time.is_finite()).collect();
    runs.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut front: Vec<(f64, f64)> = Vec::new();
    for run in runs {
        if front.last().is_none_or(|last| run.0 < last.0) {
            front.push(run);
        }
    }
    front
}

/// Time of a method over that of the baseline at equal error, for each of [`ERRORS`].
pub fn ratios(rows: &[Row], scene: &str, method: &str, carries: Carries) -> [Option<f64>; ERRORS.len()] {
    ERRORS.map(|error| {
        Some(time_at(rows, scene, method, carries, error)? / time_at(rows, scene, BASELINE, carries, error)?)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(error: f64, least: f64) -> Row {
        Row {
            scene: "a".to_owned(),
            method: "m".to_owned(),
            carries: Carries::Axis,
            setting: 0.0,
            error,
            times: Times { least, median: 2.0 * least },
            steps: 0,
            evaluations: 0,
        }
    }

    #[test]
    fn times_are_interpolated_in_logarithms_along_the_best_runs() {
        let rows = [row(1e-4, 1.0), row(1e-6, 4.0), row(1e-5, 9.0), row(f64::NAN, 0.1)];
        let at = |error: f64| time_at(&rows, "a", "m", Carries::Axis, error);
        assert!((at(1e-5).expect("reached") - 2.0).abs() < 1e-12);
        assert_eq!(at(1e-7), None);
        assert_eq!(at(1e-2), Some(1.0));
        assert_eq!(time_at(&rows, "a", "m", Carries::Orientation, 1e-5), None);
    }
}
