//! Our side of `scripts/peers`: runs one method on one scene for each line of standard input, with the protocol of
//! `tools/peers/README.md`.

use std::io::{self, BufRead as _, Write as _};

use twofold_bench::method::{MANY_SCENES, METHODS, Method, SAMPLED, WITH_PULSES};
use twofold_bench::scaling::set_up;
use twofold_bench::scene::{BenchScene, DURATION};
use twofold_bench::{Effort, timing::clock};

/// Length of a long motion (t_c).
const LONG: f64 = 1e6;

/// A task and a method for it.
struct Case {
    task: String,
    /// Length of the motion (t_c).
    duration: f64,
    /// Scenes of one run.
    scenes: usize,
    method: Method,
}

fn all() -> Vec<Case> {
    let case = |task: &str, duration, scenes, method: &Method| Case {
        task: task.to_owned(),
        duration,
        scenes,
        method: *method,
    };
    let plain = METHODS.iter().map(|method| case(&method.carries.to_string(), DURATION, 1, method));
    let pulses = WITH_PULSES.iter().map(|method| case("pulses", DURATION, 1, method));
    let many = MANY_SCENES.iter().map(|(method, count)| case("many scenes", DURATION, *count, method));
    let long = SAMPLED.iter().map(|method| case("long", LONG, 1, method));
    plain.chain(pulses).chain(many).chain(long).collect()
}

fn main() -> Result<(), String> {
    let (scenes, cases) = (BenchScene::all(), all());
    let set_up = set_up(&Effort::QUICK)?;
    let mut out = io::stdout().lock();
    for line in io::stdin().lock().lines() {
        let line = line.map_err(|error| error.to_string())?;
        let words: Vec<_> = line.split('\t').collect();
        let answer = match words[..] {
            ["methods"] => {
                let settings = |method: &Method| method.settings.iter().map(|s| format!("{s:e}")).collect::<Vec<_>>();
                let line = |Case { task, method, .. }: &Case| {
                    format!("{}\t{task}\t{}", method.name, settings(method).join(" "))
                };
                cases.iter().map(line).collect::<Vec<_>>().join("\n") + "\n"
            }
            ["run", name, task, scene, setting, repeats] => {
                let case = cases.iter().find(|case| case.task == task && case.method.name == name);
                let scene = scenes.iter().find(|s| s.name == scene);
                let (Some(case), Some(scene)) = (case, scene) else { return Err(line) };
                let setting = setting.parse().map_err(|_| line.clone())?;
                run(case, scene, setting, repeats.parse().map_err(|_| line.clone())?, set_up)?
            }
            _ => return Err(line),
        };
        writeln!(out, "{answer}").and_then(|()| out.flush()).map_err(|error| error.to_string())?;
    }
    Ok(())
}

fn run(case: &Case, scene: &BenchScene, setting: f64, repeats: usize, set_up: f64) -> Result<String, String> {
    let mut times = Vec::new();
    let mut end = None;
    for _ in 0..repeats {
        let start = clock();
        end = Some(std::hint::black_box((case.method.run)(scene, case.duration, setting)?));
        times.push(format!("{:e}", (clock() - start) / case.scenes as f64));
    }
    let Some(end) = end else { return Err("no repeats".to_owned()) };
    let vectors = [Some(end.axis), Some(end.momentum), end.equatorial_axis];
    let numbers: Vec<_> = vectors.iter().flatten().flatten().map(|x| format!("{x:e}")).collect();
    Ok(format!("{}\t{}\t{}\t{set_up:e}\t{}", times.join(" "), end.steps, end.evaluations, numbers.join(" ")))
}
