//! Our side of `scripts/peers`: runs one method on one scene for each line of standard input. The protocol is that of
//! `tools/peers/README.md`.

use std::io::{self, BufRead as _, Write as _};

use twofold_command::bench::method::{MANY_SCENES, METHODS, Method, WITH_PULSES};
use twofold_command::bench::scaling::set_up;
use twofold_command::bench::scene::{BenchScene, DURATION};
use twofold_command::bench::{Effort, timing::clock};

/// Name, task, scenes of one run, the method.
fn all() -> Vec<(String, f64, Method)> {
    let plain = METHODS.iter().map(|method| (method.carries.to_string(), 1.0, *method));
    let pulses = WITH_PULSES.iter().map(|method| ("pulses".to_owned(), 1.0, *method));
    let many = MANY_SCENES.iter().map(|(method, count)| ("many scenes".to_owned(), *count as f64, *method));
    plain.chain(pulses).chain(many).collect()
}

fn main() -> Result<(), String> {
    let (scenes, methods) = (BenchScene::all(), all());
    let set_up = set_up(&Effort::QUICK)?;
    let mut out = io::stdout().lock();
    for line in io::stdin().lock().lines() {
        let line = line.map_err(|error| error.to_string())?;
        let words: Vec<_> = line.split('\t').collect();
        let answer = match words[..] {
            ["methods"] => {
                let settings = |method: &Method| method.settings.iter().map(|s| format!("{s:e}")).collect::<Vec<_>>();
                let line = |(task, _, method): &(String, f64, Method)| {
                    format!("{}\t{task}\t{}", method.name, settings(method).join(" "))
                };
                methods.iter().map(line).collect::<Vec<_>>().join("\n") + "\n"
            }
            ["run", name, task, scene, setting, repeats] => {
                let method = methods.iter().find(|(t, _, method)| t == task && method.name == name);
                let scene = scenes.iter().find(|s| s.name == scene);
                let (Some((_, share, method)), Some(scene)) = (method, scene) else { return Err(line) };
                let setting = setting.parse().map_err(|_| line.clone())?;
                run(method, *share, scene, setting, repeats.parse().map_err(|_| line.clone())?, set_up)?
            }
            _ => return Err(line),
        };
        writeln!(out, "{answer}").and_then(|()| out.flush()).map_err(|error| error.to_string())?;
    }
    Ok(())
}

fn run(
    method: &Method,
    share: f64,
    scene: &BenchScene,
    setting: f64,
    repeats: usize,
    set_up: f64,
) -> Result<String, String> {
    let mut times = Vec::new();
    let mut end = None;
    for _ in 0..repeats {
        let start = clock();
        end = Some(std::hint::black_box((method.run)(scene, DURATION, setting)?));
        times.push(format!("{:e}", (clock() - start) / share));
    }
    let Some(end) = end else { return Err("no repeats".to_owned()) };
    let vectors = [Some(end.axis), Some(end.momentum), end.equatorial_axis];
    let numbers: Vec<_> = vectors.iter().flatten().flatten().map(|x| format!("{x:e}")).collect();
    Ok(format!("{}\t{}\t{}\t{set_up:e}\t{}", times.join(" "), end.steps, end.evaluations, numbers.join(" ")))
}
