//! Errors over long times by every method, with the exponents of their growth: the tables of docs/reliability/long-times.md.
//!
//! `cargo run --release -p twofold-tools --bin long_times [LONGEST, default 1e7 t_c]`: some minutes.
//!
//! Numerical methods and averaged motion along tp-II are compared with the reference of tools/bench/data/long.csv, closed forms with
//! themselves in double-double numbers, along motions for which they are intended.

use nalgebra::{Matrix3, Vector3};
use twofold::dynamics::{BodyState, Problem};
use twofold::numerics::scalar::{Real, Scalar};
use twofold::numerics::straight_line::{Slope, order};
use twofold::propagation::{Motion, SymmetricMotion, TorusMotion, UniformMotion};
use twofold::solutions::averaged::{AveragedSolution, AveragingOrder};
use twofold_bench::growth::{self, references};
use twofold_bench::scene::BenchScene;
use twofold_bench::{Effort, growth::METHODS};
use twofold_tools::argument;
use twofold_verify::check::largest;
use twofold_verify::double_double::DoubleDouble;

type Failure = Box<dyn std::error::Error>;

/// The error of a method at a time.
type ErrorAt<'a> = Box<dyn Fn(f64) -> Result<f64, Failure> + 'a>;

fn main() -> Result<(), Failure> {
    let longest: f64 = argument(0, 1e7);
    let effort = Effort { longest, ..Effort::FULL };
    let rows = growth::measure(&effort, |part| eprint!("\r{:3.0} %", 100.0 * part))?;
    eprintln!();
    println!("| method | time (t_c) | energy | K | error of n |\n|---|---:|---:|---:|---:|");
    for row in &rows {
        println!(
            "| {} | {:.0e} | {:.1e} | {:.1e} | {:.1e} |",
            row.method, row.time, row.energy, row.clebsch, row.phase
        );
    }
    println!("\n| method | energy | K | error of n |\n|---|---:|---:|---:|");
    for method in METHODS {
        let of = |error: fn(&growth::Row) -> f64| written(growth::exponent(&rows, method.name, error));
        println!(
            "| {} | {} | {} | {} |",
            method.name,
            of(|row| row.energy),
            of(|row| row.clebsch),
            of(|row| row.phase)
        );
    }

    let problem = BenchScene::named("tp-II").problem;
    let (spheroid, initial) = (*problem.spheroid(), *problem.initial());
    let beside_reference = |axis: Vector3<f64>, t: f64| -> Result<f64, Failure> {
        let reference = references().into_iter().find(|(time, _)| *time == t).ok_or("no reference at this time")?;
        let difference = axis.map(DoubleDouble::from_f64) - reference.1;
        Ok(largest(difference.iter().map(|x: &DoubleDouble| x.high().abs())))
    };
    let averaged = |order| -> Result<ErrorAt, Failure> {
        let motion = AveragedSolution::new(&problem, order)?;
        Ok(Box::new(move |t| beside_reference(motion.state(t).axis, t)))
    };
    let torus = TorusMotion::new(&problem, (0.0, longest), 1e-15)?;
    let by_torus: ErrorAt = Box::new(move |t| beside_reference(torus.axis_state(t)?.axis, t));
    // tp-II's body with another tensor, and at rest except for a spin along the third principal axis.
    let symmetric = Matrix3::from_diagonal(&Vector3::new(0.013, 0.013, -0.04));
    let tilted = Problem::new(spheroid, symmetric, initial)?;
    let free = Problem::new(spheroid, Matrix3::zeros(), initial)?;
    let momentum = Vector3::z() * initial.momentum.norm();
    let upright = tilted.starting_from(BodyState { axis: Vector3::z(), momentum, equatorial_axis: Vector3::x() })?;
    let span = (0.0, 1e7);
    let lifted = |problem: &Problem<f64>| -> Problem<DoubleDouble> { problem.map(DoubleDouble::from_f64) };
    let methods: [(&str, ErrorAt); 6] = [
        ("series on the torus", by_torus),
        ("averaged motion, first order", averaged(AveragingOrder::First)?),
        ("averaged motion, second order", averaged(AveragingOrder::Second)?),
        (
            "symmetric solution",
            difference(SymmetricMotion::new(&tilted, span)?, SymmetricMotion::new(&lifted(&tilted), span)?),
        ),
        ("free rotation", difference(UniformMotion::free(&free, span), UniformMotion::free(&lifted(&free), span))),
        (
            "steady precession",
            difference(UniformMotion::steady(&upright, span)?, UniformMotion::steady(&lifted(&upright), span)?),
        ),
    ];
    let decades: Vec<f64> = (2..=7).map(|k| 10f64.powi(k)).filter(|t| *t <= longest).collect();
    let head: Vec<String> = decades.iter().map(|t| format!(" {t:.0e} ")).collect();
    println!(
        "\n| method, error of n at t (t_c) |{}| exponent |\n|---|{}---:|",
        head.join("|"),
        "---:|".repeat(decades.len())
    );
    for (name, error) in methods {
        let mut points = Vec::new();
        for t in &decades {
            points.push((*t, error(*t).unwrap_or(f64::NAN)));
        }
        let cells: Vec<String> = points.iter().map(|(_, error)| format!(" {error:.1e} ")).collect();
        points.retain(|point| point.1.is_finite());
        println!("| {name} |{}| {} |", cells.join("|"), written(order(&points, 0.0).ok()));
    }
    Ok(())
}

/// An exponent with its standard error.
fn written(exponent: Option<Slope>) -> String {
    exponent.map_or("-".into(), |slope| format!("{:.2} +- {:.2}", slope.value, slope.error))
}

/// The error of n and e_x of a closed form in doubles, compared with itself in double-double numbers.
fn difference<'a>(
    motion: impl Motion<f64, State = BodyState<f64>> + 'a,
    exact: impl Motion<DoubleDouble, State = BodyState<DoubleDouble>> + 'a,
) -> ErrorAt<'a> {
    Box::new(move |t| {
        let (state, exact) = (motion.state(t)?, exact.state(DoubleDouble::from_f64(t))?);
        let off = |a: &Vector3<f64>, b: &Vector3<DoubleDouble>| {
            largest(a.iter().zip(b).map(|(a, b)| (DoubleDouble::from_f64(*a) - *b).re().abs()))
        };
        Ok(largest([off(&state.axis, &exact.axis), off(&state.equatorial_axis, &exact.equatorial_axis)]))
    })
}
