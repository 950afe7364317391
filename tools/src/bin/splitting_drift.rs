//! Conservation over very many steps of tp-II: `|n| - 1`, drift of L.n and of the energy, with the slope of the energy in time.
//!
//!     cargo run --release -p twofold-tools --bin splitting_drift [STEPS, default 1e9]

use twofold::dynamics::AxisState;
use twofold::numerics::straight_line::slope;
use twofold::propagation::splitting::{GRADIENT_8_6_6, Splitting};
use twofold_tools::argument;
use twofold_verify::random::Random;
use twofold_verify::reference::reference_motion;

fn main() {
    let steps: f64 = argument(0, 1e9);
    let problem = reference_motion("tp-2").problem().reduced();
    let (s, start) = (problem.coefficients(), problem.initial());
    let step = 0.6;
    let mut motion = Splitting::new(&problem, &GRADIENT_8_6_6, step).expect("tp-II is in the domain");
    let energy = |state: &AxisState<f64>| {
        state.momentum.norm_squared() / 2.0 + problem.spheroid().constant_c * state.axis.dot(&(s * state.axis))
    };
    let (energy_0, spin_0) = (energy(start), start.axis.dot(&start.momentum));
    const ROWS: u32 = 1000;
    let (mut axis, mut spin, mut points) = (0.0_f64, 0.0_f64, Vec::new());
    let mut random = Random::with_seed(1);
    for row in 1..=ROWS {
        // The times are random: equal distances would alias the oscillation of the energy, of period 177 t_c, into a slow one.
        let offset = random.word() % 10_000;
        motion.advance(offset);
        let state = motion.state();
        motion.advance((steps / f64::from(ROWS)) as u64 - offset);
        axis = axis.max((state.axis.norm() - 1.0).abs());
        spin = spin.max((state.axis.dot(&state.momentum) - spin_0).abs());
        points.push((f64::from(row) / f64::from(ROWS), energy(&state) - energy_0));
    }
    let fit = slope(&points).expect("a thousand points");
    let most = points.iter().fold(0.0_f64, |most, (_, error)| most.max(error.abs()));
    println!("{} steps of {step} t_c, {} stages each", steps, GRADIENT_8_6_6.stages());
    println!("largest ||n| - 1| {axis:.2e}, largest drift of L.n {spin:.2e}");
    println!("energy: largest error {most:.2e}; trend over the whole run {:.2e} +- {:.1e}", fit.value, fit.error);
}
