//! `twofold run`.

use clap::Args;
use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::PathBuf;

use super::output_file::OutputFile;
use super::progress::Progress;
use super::standard_output::standard_output;
use super::{Failure, note, print};
use twofold::dynamics::equations_of_motion::angular_velocity;
use twofold_scene::explained_plan::{bytes, explained};
use twofold_scene::scene_file::{Columns, Scene};
use twofold_scene::trajectory::{self, Summary, TrajectoryError};

#[derive(Args)]
pub(crate) struct RunArgs {
    /// A built-in scene (see `twofold scenes`) or the path of a scene file (TOML)
    pub(crate) scene: String,
    /// Write only these groups of columns, regardless of the scene: angles, rates, e_x, e_z, L, integrals, perturbation, lambda,
    /// m.n, magnetic_axis, position_angle, h
    #[arg(long, value_name = "GROUP,GROUP", value_delimiter = ',')]
    pub(crate) columns: Option<Vec<String>>,
    #[command(flatten)]
    pub(crate) window: WindowArgs,
    #[command(flatten)]
    pub(crate) plan: PlanArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

/// A part of the motion.
#[derive(Args)]
pub(crate) struct WindowArgs {
    /// Begin at this time (in the unit of the scene), however late, with the state of the motion there; turns are counted from there on. If not given, the start
    /// of the scene
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) from: Option<f64>,
    /// End at this time; if not given, the end of the scene
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) to: Option<f64>,
}

impl WindowArgs {
    /// The window of a scene, or all of it.
    pub(super) fn of(&self, scene: Scene, name: &str) -> Result<Scene, Failure> {
        if self.from.is_none() && self.to.is_none() {
            return Ok(scene);
        }
        let (from, to) = (self.from.unwrap_or(scene.times.start()), self.to.unwrap_or(scene.times.last()));
        if self.to.is_none() && (to - from) * scene.duration() < 0.0 {
            return Err(Failure::BadInput(format!(
                "{name}: --from {from:?} is after the end of the scene, {to:?}; give --to as well"
            )));
        }
        let window = scene.window(from, to).map_err(|why| Failure::BadInput(format!("{name}: {why}")));
        let (scene, error) = window?;
        let of = components(&scene);
        note(&format!("estimated error of {of} at the start of the window: {error:.1e}"));
        Ok(scene)
    }
}

#[derive(Args)]
pub(crate) struct PlanArgs {
    /// Compute nothing; print the plan, what it skips and why, and its expected cost
    #[arg(long)]
    pub(crate) explain: bool,
    /// The method, instead of the cheapest that meets the tolerance: free, steady, symmetric, averaged, torus, splitting, taylor
    #[arg(long, value_name = "NAME")]
    pub(crate) method: Option<String>,
}

#[derive(Args)]
pub(crate) struct OutputArgs {
    /// Write the table to this file instead of standard output; the file appears only when it is complete
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}

pub(super) fn run(args: &RunArgs) -> Result<(), Failure> {
    let names: Option<Vec<_>> = args.columns.as_ref().map(|names| names.iter().map(|name| name.trim()).collect());
    let refused = |why: String| Failure::BadInput(format!("{}: {why}", args.scene));
    let scene = if args.plan.method.is_none() {
        read_scene(&args.scene, names.as_deref().map_or(Columns::OfTheFile, Columns::Named))?
    } else {
        // The span over which columns can be computed depends on the method, which may differ from that of the file.
        let mut scene = read_scene(&args.scene, names.as_ref().map_or(Columns::OfTheFileLater, |_| Columns::Unused))?;
        force_method(&mut scene, &args.plan, &args.scene)?;
        if let Some(names) = names {
            scene.choose_columns(&names).map_err(|why| refused(format!("--columns: {why}")))?;
        }
        scene.check_rotation(&scene.columns).map_err(refused)?;
        scene
    };
    let start = scene.times.start();
    let scene = args.window.of(scene, &args.scene)?;
    let elapsed = (scene.times.last() - start) / scene.units.time;
    let turned = f64::EPSILON * elapsed.abs() * angular_velocity_at_start(&scene);
    for output in &scene.columns {
        scene.has_what_is_needed_for(*output).map_err(refused)?;
    }
    if args.plan.explain {
        return print(&explained(&scene, &scene.plan(&scene.columns)?));
    }
    note_size(scene.times.count() as f64, trajectory::header(&scene).len());
    let Some(summary) =
        write(&args.output, &scene, |writer, progress| trajectory::write_csv(&scene, writer, progress))?
    else {
        return Ok(());
    };
    note_poles(&scene, &summary);
    if let Some(error) = summary.error {
        note(&format!("estimated error of {} at the end of the span: {error:.1e}", components(&scene)));
        if turned > error.max(LEAST_TURNED) {
            note(&format!(
                "that error is for the initial state as rounded to doubles; its last digit turns the star by {turned:.1e} rad by then"
            ));
        }
    }
    Ok(())
}

/// Smallest reported rotation by the last digit of the initial state, in rad.
const LEAST_TURNED: f64 = 1e-10;

/// Angular velocity at the start, per `t_c`.
fn angular_velocity_at_start(scene: &Scene) -> f64 {
    let (body, state) = (scene.problem.spheroid(), scene.problem.initial());
    angular_velocity(body, &state.axis, &state.momentum).norm()
}

/// The quantities to which an estimated error refers. `L` is divided by its size, or by the size that the torque can produce if that is larger.
fn components(scene: &Scene) -> &'static str {
    let (body, s, l) = (scene.problem.spheroid(), scene.problem.coefficients(), scene.problem.initial().momentum);
    let values = s.symmetric_eigenvalues();
    let by_torque = 2.0 * body.inertia_xx * body.constant_c * (values.max() - values.min());
    if l.norm_squared() < by_torque { "n, e_x and L / (2 I^xx C (s_max - s_min))^(1/2)" } else { "n, e_x and L / |L|" }
}

pub(super) fn force_method(scene: &mut Scene, args: &PlanArgs, name: &str) -> Result<(), Failure> {
    let Some(method) = &args.method else { return Ok(()) };
    scene.choose_method(method).map_err(|why| Failure::BadInput(format!("--method for {name}: {why}")))
}

/// The scene for a command that ignores spin-down, with notes on probable mistakes.
pub(super) fn read_scene(name: &str, columns: Columns<'_>) -> Result<Scene, Failure> {
    let scene = read_with_spin_down(name, columns)?;
    if scene.spin_down.is_some() {
        note(&format!(
            "{name}: [spin_down] is for `twofold timing`; here the star keeps the rotation rate that it has at the epoch"
        ));
    }
    Ok(scene)
}

/// The scene, with notes on probable mistakes.
pub(super) fn read_with_spin_down(name: &str, columns: Columns<'_>) -> Result<Scene, Failure> {
    let scene = Scene::named_with(name, columns)?;
    scene.cautions.iter().for_each(|caution| note(&format!("{name}: {caution}")));
    Ok(scene)
}

/// Bytes of a number in a table: usually 16 or 17 digits, a point and a comma; some have a sign or an exponent.
const BYTES_OF_A_NUMBER: f64 = 19.0;

/// Size above which the size of a table is announced (bytes).
const LARGE: f64 = 1e7;

pub(super) fn note_size(rows: f64, columns: usize) {
    let size = rows * columns as f64 * BYTES_OF_A_NUMBER;
    if size >= LARGE {
        note(&format!("the table will have {rows} rows of {columns} columns, about {}", bytes(size)));
    }
}

/// Lets `table` write to the file named in the arguments, or to standard output. `None` if the reader has closed it.
pub(super) fn write<T>(
    args: &OutputArgs,
    scene: &Scene,
    table: impl FnOnce(&mut dyn Write, &mut dyn FnMut(f64) -> io::Result<()>) -> Result<T, TrajectoryError>,
) -> Result<Option<T>, Failure> {
    let output = args.out.as_deref().map(|path| OutputFile::beside(path, args.force)).transpose()?;
    note_units(scene);
    let mut progress = Progress::new(output.is_some() || !io::stdout().is_terminal());
    let mut show = |part| {
        progress.show(part);
        Ok(())
    };
    let summary = match &output {
        None => table(&mut standard_output()?, &mut show),
        Some(output) => table(&mut BufWriter::new(output.file()), &mut show),
    };
    drop(progress);
    match summary {
        Err(error) if output.is_none() && error.is_closed_pipe() => Ok(None),
        Err(error) => Err(Failure::Failed(error.to_string())),
        Ok(summary) => {
            output.map_or(Ok(()), OutputFile::complete)?;
            Ok(Some(summary))
        }
    }
}

fn note_units(scene: &Scene) {
    if scene.units.are_physical() {
        let ratio = scene.problem.spheroid().inertia_zz / scene.problem.spheroid().inertia_xx;
        note(&format!("t_c = {:.6e} s, I^zz/I^xx = {ratio:.9}; times are in s", scene.units.time));
    }
}

fn note_poles(scene: &Scene, summary: &Summary) {
    if let Some(time) = summary.first_on_pole {
        note(&format!(
            "an axis is on a pole in {} of {} rows, first at t = {time:?} {}: alpha, gamma and the rates are undefined where the \
             symmetry axis is, Theta and Phi where the magnetic axis is, psi where that is along the line of sight; these fields \
             are left empty",
            summary.rows_on_pole, summary.rows, scene.units.time_name
        ));
    }
}

#[cfg(test)]
mod tests {
    use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
    use twofold::nalgebra::{Matrix3, Vector3};

    use super::*;

    /// Eigenvalues differ by 0.05: with `I^xx = 2` and `C = 3` the torque can produce `L^2 = 2 I^xx C 0.05 = 0.6`.
    #[test]
    fn an_error_of_l_is_relative_to_the_size_that_the_torque_produces_if_that_is_larger() {
        let mut scene = Scene::named("tp-2").unwrap();
        let star = RigidSpheroid { inertia_xx: 2.0, inertia_zz: 2.5, constant_c: 3.0 };
        let s = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.03));
        for (square, is_of_torque) in [(0.59_f64, true), (0.61, false)] {
            let momentum = Vector3::new(0.6, 0.0, -0.8) * square.sqrt();
            let state = BodyState { axis: Vector3::z(), momentum, equatorial_axis: Vector3::x() };
            scene.problem = Problem::new(star, s, state).unwrap();
            assert_eq!(components(&scene).contains("s_max - s_min"), is_of_torque, "{square}");
        }
    }
}
