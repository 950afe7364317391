//! Growth of the energy error along Taylor series at the tolerance 1e-16, for tp-II and random scenes, relative to the sum of the magnitudes of
//! its terms, with the exponents of growth.
//!
//!     cargo run --release -p twofold-tools --bin taylor_drift [SCENES, default 20] [SEED, default 1] [LONGEST, default 1e6 t_c]

use rayon::prelude::*;
use twofold::Scalar as _;
use twofold::dynamics::first_integrals::first_integrals;
use twofold::dynamics::{AxisState, Problem};
use twofold::numerics::straight_line::order;
use twofold_bench::scene::BenchScene;
use twofold_tools::argument;
use twofold_verify::double_double::DoubleDouble;
use twofold_verify::error_scenes::ErrorScene;

/// States per decade of time.
const STATES: i32 = 100;

type Failure = Box<dyn std::error::Error + Send + Sync>;

/// Largest error of the energy so far at 1e2, 1e3, ... t_c, relative to its terms.
fn errors(problem: &Problem<f64>, longest: f64) -> Result<Vec<(f64, f64)>, Failure> {
    let (body, problem) = (*problem.spheroid(), problem.reduced());
    let unit = (body.inertia_xx / body.constant_c.abs()).sqrt();
    let decades = longest.log10().round() as i32;
    let times: Vec<f64> = (STATES..=STATES * decades).map(|i| 10f64.powf(f64::from(i) / f64::from(STATES))).collect();
    let lifted = problem.map(DoubleDouble::from_f64);
    let energy = |state: &AxisState<f64>| {
        let lift = |v: &nalgebra::Vector3<f64>| v.map(DoubleDouble::from_f64);
        let state = AxisState { axis: lift(&state.axis), momentum: lift(&state.momentum) };
        first_integrals(lifted.spheroid(), lifted.coefficients(), &state).energy
    };
    let in_units: Vec<f64> = times.iter().map(|t| t * unit).collect();
    let states = problem.taylor_states(0.0, &in_units, 1e-16)?.states;
    let start = problem.initial();
    let scale = start.momentum.norm_squared() / 2.0 / body.inertia_xx
        + body.constant_c.abs() * start.axis.abs().dot(&(problem.coefficients().abs() * start.axis.abs()));
    let (mut largest, mut found) = (0.0_f64, Vec::new());
    for (i, (t, state)) in times.iter().zip(&states).enumerate() {
        largest = largest.max((energy(state) - energy(start)).high().abs() / scale);
        if i > 0 && i % STATES as usize == 0 {
            found.push((*t, largest));
        }
    }
    Ok(found)
}

fn main() -> Result<(), Failure> {
    let (scenes, seed, longest): (u64, u64, f64) = (argument(0, 20), argument(1, 1), argument(2, 1e6));
    let print = |name: &str, found: &[(f64, f64)]| {
        let late: Vec<_> = found.iter().copied().filter(|(t, _)| *t > 500.0).collect();
        let slope = order(&late, 0.0).map_or("-".to_owned(), |p| format!("{:.2} +- {:.2}", p.value, p.error));
        let cells: Vec<_> = found.iter().map(|(_, error)| format!("{error:.1e}")).collect();
        println!("| {name} | {} | {slope} |", cells.join(" | "));
    };
    let drawn = (0..scenes).into_par_iter().map(|i| errors(&ErrorScene::draw(seed, i).problem, longest));
    let drawn = drawn.collect::<Result<Vec<_>, _>>()?;
    let tp_ii = errors(&BenchScene::named("tp-II").problem, longest)?;
    let times: Vec<_> = tp_ii.iter().map(|(t, _)| format!("{t:.0e}")).collect();
    println!("| scene | {} | exponent from 1e3 |\n|---|{}", times.join(" | "), "---:|".repeat(times.len() + 1));
    print("tp-II", &tp_ii);
    for (i, found) in drawn.iter().enumerate() {
        print(&i.to_string(), found);
    }
    let at = |k: usize| {
        let mut of_all: Vec<f64> = drawn.iter().map(|found| found[k].1).collect();
        of_all.sort_by(f64::total_cmp);
        (tp_ii[k].0, of_all[of_all.len() / 2])
    };
    print("median", &(0..tp_ii.len()).map(at).collect::<Vec<_>>());
    Ok(())
}
