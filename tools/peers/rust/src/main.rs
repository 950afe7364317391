//! Runge-Kutta methods of other crates on the scenes of `twofold bench`, by the protocol of `tools/peers/README.md`.

use std::hint::black_box;
use std::io::{self, BufRead as _, Write as _};

use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, SVector, System};

const DURATION: f64 = 1000.0;
const TOLERANCES: &str = "1e-4 1e-5 1e-6 1e-7 1e-8 1e-9 1e-10 1e-11 1e-12 1e-13 1e-14";

/// A scene: `I^zz`, `s`, `n`, `L`, `e_x` in units `I^xx = C = 1`.
struct Scene {
    name: String,
    inertia: f64,
    s: [f64; 3],
    start: [f64; 9],
}

fn scenes() -> Vec<Scene> {
    let text = include_str!("../../../../tools/bench/data/scenes.csv");
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let scene = |row: &str| {
        let (name, numbers) = row.split_once(',').expect("a row of numbers");
        let v: Vec<f64> = numbers.split(',').map(|cell| cell.parse().expect("a number")).collect();
        Scene {
            name: name.to_owned(),
            inertia: v[0],
            s: [v[1], v[2], v[3]],
            start: v[4..13].try_into().expect("nine components"),
        }
    };
    rows.map(scene).collect()
}

/// `dn/dt = L x n`, `dL/dt = -2 n x (s n)`, and with nine components `d e_x/dt = (L - (1 - 1/I^zz) (L.n) n) x e_x`.
#[inline(always)]
fn rates<const N: usize>(scene: &Scene, y: &[f64; N], dy: &mut [f64; N]) {
    let [s, n, l] = [scene.s, [y[0], y[1], y[2]], [y[3], y[4], y[5]]];
    let twice = [2.0 * s[0] * n[0], 2.0 * s[1] * n[1], 2.0 * s[2] * n[2]];
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    dy[..3].copy_from_slice(&cross(l, n));
    dy[3..6].copy_from_slice(&cross(twice, n));
    if N == 9 {
        let turn = (1.0 - 1.0 / scene.inertia) * (l[0] * n[0] + l[1] * n[1] + l[2] * n[2]);
        let omega = [l[0] - turn * n[0], l[1] - turn * n[1], l[2] - turn * n[2]];
        dy[6..9].copy_from_slice(&cross(omega, [y[6], y[7], y[8]]));
    }
}

struct Problem<'a, const N: usize>(&'a Scene);

impl<const N: usize> System<f64, SVector<f64, N>> for Problem<'_, N> {
    fn system(&self, _: f64, y: &SVector<f64, N>, dy: &mut SVector<f64, N>) {
        rates(self.0, &y.data.0[0], &mut dy.data.0[0]);
    }
}

impl<const N: usize> ODE<f64, [f64; N]> for Problem<'_, N> {
    fn diff(&self, _: f64, y: &[f64; N], dy: &mut [f64; N]) {
        rates(self.0, y, dy);
    }
}

struct End {
    steps: usize,
    evaluations: usize,
    state: Vec<f64>,
}

fn dop853<const N: usize>(scene: &Scene, tolerance: f64) -> Result<End, String> {
    let start = SVector::<f64, N>::from_column_slice(&scene.start[..N]);
    let problem = Problem::<N>(scene);
    let mut solver = Dop853::from_param(
        problem, 0.0, DURATION, DURATION, start, tolerance, tolerance, 0.9, 0.0, 0.333, 6.0, DURATION, 0.0, 10_000_000,
        u32::MAX, OutputType::Sparse,
    );
    let stats = solver.integrate().map_err(|error| error.to_string())?;
    let state = solver.y_out().last().ok_or("no state")?.as_slice().to_vec();
    let steps = (stats.accepted_steps + stats.rejected_steps) as usize;
    Ok(End { steps, evaluations: stats.num_eval as usize, state })
}

fn rkv988e<const N: usize>(scene: &Scene, tolerance: f64) -> Result<End, String> {
    let start: [f64; N] = scene.start[..N].try_into().map_err(|_| "components")?;
    let method = ExplicitRungeKutta::rkv988e().rtol(tolerance).atol(tolerance).max_steps(10_000_000);
    let problem = Problem::<N>(scene);
    let solution = IVP::ode(&problem, 0.0, DURATION, start)
        .method(method)
        .solve()
        .map_err(|error| format!("{error:?}"))?;
    let state = solution.y.last().ok_or("no state")?.to_vec();
    Ok(End { steps: solution.steps.total(), evaluations: solution.evals.function, state })
}

type Run = fn(&Scene, f64) -> Result<End, String>;

const METHODS: [(&str, &str, Run); 4] = [
    ("ode_solvers Dop853", "n L", dop853::<6>),
    ("ode_solvers Dop853", "n L e_x", dop853::<9>),
    ("differential-equations RKV98", "n L", rkv988e::<6>),
    ("differential-equations RKV98", "n L e_x", rkv988e::<9>),
];

/// Seconds that this thread has worked.
fn clock() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

fn main() -> Result<(), String> {
    let scenes = scenes();
    let mut out = io::stdout().lock();
    for line in io::stdin().lock().lines() {
        let line = line.map_err(|error| error.to_string())?;
        let words: Vec<_> = line.split('\t').collect();
        let answer = match words[..] {
            ["methods"] => METHODS.map(|(name, task, _)| format!("{name}\t{task}\t{TOLERANCES}\n")).concat(),
            ["run", name, task, scene, setting, repeats] => {
                let method = METHODS.iter().find(|(n, t, _)| *n == name && *t == task).ok_or(&line)?;
                let scene = scenes.iter().find(|s| s.name == scene).ok_or(&line)?;
                let (setting, repeats) = (setting.parse().map_err(|_| &line)?, repeats.parse().map_err(|_| &line)?);
                run(method.2, scene, setting, repeats)?
            }
            _ => return Err(line),
        };
        writeln!(out, "{answer}").and_then(|()| out.flush()).map_err(|error| error.to_string())?;
    }
    Ok(())
}

fn run(method: Run, scene: &Scene, setting: f64, repeats: usize) -> Result<String, String> {
    let mut times = Vec::new();
    let mut end = None;
    for _ in 0..repeats {
        let start = clock();
        end = Some(black_box(method(scene, setting)?));
        times.push(format!("{:e}", clock() - start));
    }
    let End { steps, evaluations, state } = end.ok_or("no repeats")?;
    let numbers: Vec<_> = state.iter().map(|x| format!("{x:e}")).collect();
    Ok(format!("{}\t{steps}\t{evaluations}\t0\t{}", times.join(" "), numbers.join(" ")))
}
