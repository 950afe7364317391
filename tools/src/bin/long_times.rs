//! Errors over long times by every method, with the exponents of their growth: the tables of docs/reliability/long-times.md.
//!
//! `cargo run --release -p twofold-tools --bin long_times [LONGEST, default 1e7 t_c]`: some minutes.
//!
//! Numerical methods and averaged motion along tp-II against the reference of command/data/bench_long.csv; closed forms against themselves in
//! double-double numbers, along motions that they are made for.

use nalgebra::{Matrix3, Vector3};
use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
use twofold::numerics::scalar::{Real, Scalar};
use twofold::propagation::{AveragedMotion, Motion, SymmetricMotion, UniformMotion};
use twofold::solutions::averaged::AveragingOrder;
use twofold::straight_line::{Slope, order};
use twofold_command::bench::growth::{self, references};
use twofold_command::bench::scene::BenchScene;
use twofold_command::bench::{Effort, growth::METHODS};
use twofold_verify::check::largest;
use twofold_verify::double_double::DoubleDouble;

type Failure = Box<dyn std::error::Error>;

/// The error of a method at a time.
type ErrorAt<'a> = Box<dyn Fn(f64) -> Result<f64, Failure> + 'a>;

fn main() -> Result<(), Failure> {
    let longest: f64 = std::env::args().nth(1).map_or(Ok(1e7), |text| text.parse())?;
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

    let scene = BenchScene::named("tp-II");
    let span = (0.0, longest);
    let mean = |order| -> Result<ErrorAt, Failure> {
        let motion = AveragedMotion::new(&scene.problem, span, order)?;
        Ok(Box::new(move |t| {
            let axis = motion.state(t)?.axis.map(<DoubleDouble as Scalar>::from_f64);
            let reference = references().into_iter().find(|(time, _)| *time == t).ok_or("no reference at this time")?;
            Ok(largest((axis - reference.1).iter().map(|x: &DoubleDouble| x.high().abs())))
        }))
    };
    let symmetric = Matrix3::from_diagonal(&Vector3::new(0.013, 0.013, -0.04));
    let methods: [(&str, ErrorAt); 5] = [
        ("averaged motion, first order", mean(AveragingOrder::First)?),
        ("averaged motion, second order", mean(AveragingOrder::Second)?),
        (
            "symmetric solution",
            against_itself(&scene, &symmetric, SymmetricMotion::from_parts, SymmetricMotion::from_parts)?,
        ),
        (
            "free rotation",
            against_itself(
                &scene,
                &Matrix3::zeros(),
                |body, s, start, span| Ok(UniformMotion::free_from_parts(body, s, start, span)),
                |body, s, start, span| Ok(UniformMotion::free_from_parts(body, s, start, span)),
            )?,
        ),
        ("steady precession", {
            let upright = upright();
            against_itself(&upright, &symmetric, UniformMotion::steady_from_parts, UniformMotion::steady_from_parts)?
        }),
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

/// tp-II's body at rest but for a spin along the third principal axis.
fn upright() -> BenchScene {
    let mut scene = BenchScene::named("tp-II");
    let (body, s, momentum) =
        (*scene.problem.spheroid(), *scene.problem.coefficients(), scene.problem.initial().momentum.norm());
    let start = BodyState { axis: Vector3::z(), momentum: Vector3::z() * momentum, equatorial_axis: Vector3::x() };
    scene.problem = Problem::new(body, s, start).expect("a state");
    scene
}

type Make<S, M> = fn(&RigidSpheroid<S>, &Matrix3<S>, &BodyState<S>, (f64, f64)) -> Result<M, twofold::Error>;

/// A closed form in doubles against itself in double-double numbers, from the same start.
fn against_itself<
    'a,
    M: Motion<f64, State = BodyState<f64>> + 'a,
    D: Motion<DoubleDouble, State = BodyState<DoubleDouble>> + 'a,
>(
    scene: &BenchScene,
    s: &Matrix3<f64>,
    make: Make<f64, M>,
    make_exact: Make<DoubleDouble, D>,
) -> Result<ErrorAt<'a>, Failure> {
    let lift = <DoubleDouble as Scalar>::from_f64;
    let (body, start) = (scene.problem.spheroid(), scene.problem.initial());
    let exact_body = body.map(lift);
    let exact_start = BodyState {
        axis: start.axis.map(lift),
        momentum: start.momentum.map(lift),
        equatorial_axis: start.equatorial_axis.map(lift),
    };
    let span = (0.0, 1e7);
    let motion = make(body, s, start, span)?;
    let exact = make_exact(&exact_body, &s.map(lift), &exact_start, span)?;
    Ok(Box::new(move |t| {
        let (state, exact) = (motion.state(t)?, exact.state(lift(t))?);
        let difference = |a: &Vector3<f64>, b: &Vector3<DoubleDouble>| {
            largest(a.iter().zip(b).map(|(a, b)| (lift(*a) - *b).re().abs()))
        };
        Ok(largest([difference(&state.axis, &exact.axis), difference(&state.equatorial_axis, &exact.equatorial_axis)]))
    }))
}
