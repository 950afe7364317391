//! Random motions that the series on the torus refuses, and why, by the angle of the initial `L` to the middle axis.
//!
//! `cargo run --release -p twofold-tools --bin torus_refusals [SCENES] [SEED]`; default: 20,000 scenes of seed 1 from each of two draws, at the
//! tolerance 1e-12. The first draw is uniform over the domain: eigenvalues, directions on spheres, decades of strengths and of rates, one start in
//! twenty from rest. The second is that of `estimates_by_method`, in which four in ten start beside the middle axis, down to 1e-12 rad, and as many
//! have two nearly equal eigenvalues.

use std::collections::BTreeMap;
use std::time::Instant;

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use twofold::Error;
use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
use twofold::lorentz_violation::principal_frame;
use twofold::solutions::torus::TorusSolution;
use twofold_verify::averaged_scenes::direction;
use twofold_verify::error_scenes::ErrorScene;
use twofold_verify::random::Random;

const TOLERANCE: f64 = 1e-12;

fn main() {
    let argument =
        |place: usize, usual: u64| std::env::args().nth(place).map_or(usual, |text| text.parse().expect("a number"));
    let (scenes, seed) = (argument(1, 20_000), argument(2, 1));
    let of = |number: u64| Random::with_seed(Random::with_seed(seed.wrapping_mul(0x1_0000_0001) + number).word());
    told("uniform over the domain", (0..scenes).map(|number| uniform(&mut of(number))));
    told("with many near the edges", (0..scenes).map(|number| ErrorScene::draw(seed, number).problem));
}

/// A motion of a body with inertia one and `|C| = 1`; other units would change nothing.
fn uniform(random: &mut Random) -> Problem<f64> {
    let spheroid = RigidSpheroid {
        inertia_xx: 1.0,
        inertia_zz: random.within(0.6, 2.0),
        constant_c: random.within(-1.0, 1.0).signum(),
    };
    let strength = 10f64.powf(random.within(-8.0, 0.0));
    let eigenvalues = Vector3::from_fn(|_, _| strength * random.within(-1.0, 1.0));
    let frame =
        Rotation3::from_axis_angle(&Unit::new_normalize(direction(random)), random.within(0.0, core::f64::consts::TAU));
    let tensor = frame.matrix() * Matrix3::from_diagonal(&eigenvalues) * frame.matrix().transpose();
    let size = if random.within(0.0, 1.0) < 0.05 { 0.0 } else { 10f64.powf(random.within(-4.0, 1.0)) };
    let axis = direction(random);
    let equatorial_axis = axis.cross(&direction(random)).normalize();
    let initial = BodyState { axis, momentum: direction(random) * size, equatorial_axis };
    Problem::new(spheroid, (tensor + tensor.transpose()) / 2.0, initial).expect("parts of the domain")
}

/// Angle between the initial `L` and the axis of the middle eigenvalue; a right angle for a star at rest.
fn from_middle_axis(problem: &Problem<f64>) -> f64 {
    let frame = principal_frame(problem.coefficients()).expect("a symmetric tensor").principal_from_given;
    let values = (frame * problem.coefficients() * frame.transpose()).diagonal();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let middle: Vector3<f64> = frame.row(order[1]).transpose();
    let momentum = problem.initial().momentum;
    if momentum.norm() == 0.0 {
        return core::f64::consts::FRAC_PI_2;
    }
    middle.cross(&momentum).norm().atan2(middle.dot(&momentum).abs())
}

/// Prints a table of refusals by decades of the angle.
fn told(name: &str, problems: impl Iterator<Item = Problem<f64>>) {
    let mut decades: BTreeMap<i32, (usize, BTreeMap<&str, usize>)> = BTreeMap::new();
    let (mut all, mut refused, mut longest) = (0, 0, [0.0_f64; 2]);
    for problem in problems {
        let decade = from_middle_axis(&problem).log10().floor().max(-13.0) as i32;
        let (count, reasons) = decades.entry(decade).or_default();
        (all, *count) = (all + 1, *count + 1);
        let start = Instant::now();
        let found = TorusSolution::new(&problem, TOLERANCE, 1.0);
        let took = &mut longest[usize::from(found.is_err())];
        *took = took.max(start.elapsed().as_secs_f64());
        if let Err(why) = found {
            refused += 1;
            *reasons.entry(what(&why)).or_default() += 1;
        }
    }
    println!("{name}: {refused} of {all} refused, {:.2} %", 100.0 * f64::from(refused) / f64::from(all));
    println!("longest set-up {:.2} s, longest refusal {:.2} s", longest[0], longest[1]);
    for (decade, (count, reasons)) in decades.iter().rev() {
        let refused: usize = reasons.values().sum();
        println!("  L 1e{decade} to 1e{} rad from the middle axis: {refused} of {count} {reasons:?}", decade + 1);
    }
}

fn what(error: &Error) -> &'static str {
    match error {
        Error::NotConverged { what, .. } | Error::Unsupported { what, .. } => what,
        _ => "outside the domain",
    }
}
