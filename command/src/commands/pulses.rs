//! `twofold pulses`.

use clap::Args;
use twofold::plan::Output;
use twofold_scene::scene_file::Columns;

use super::run::{OutputArgs, PlanArgs, WindowArgs, force_method, read_scene, write};
use super::{Failure, counted, note, print};
use twofold_scene::explained_plan::explained;
use twofold_scene::plan::LARGEST_ROTATION;
use twofold_scene::trajectory::write_pulses;

#[derive(Args)]
pub(crate) struct PulsesArgs {
    /// A built-in scene (see `twofold scenes`) or the path of a scene file (TOML)
    pub(crate) scene: String,
    /// Include the opposite beam too, regardless of the scene
    #[arg(long)]
    pub(crate) second_beam: bool,
    #[command(flatten)]
    pub(crate) window: WindowArgs,
    #[command(flatten)]
    pub(crate) plan: PlanArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

pub(super) fn pulses(args: &PulsesArgs) -> Result<(), Failure> {
    let mut scene = read_scene(&args.scene, Columns::Unused)?;
    force_method(&mut scene, &args.plan, &args.scene)?;
    scene.has_what_is_needed_for(Output::Pulses).map_err(|lacks| {
        let why = "without which it has no pulses (docs/scenes.md describes it)";
        Failure::BadInput(format!("{}: {lacks}, {why}", args.scene))
    })?;
    if let Some(pulsar) = &mut scene.pulsar {
        pulsar.second_beam |= args.second_beam;
    }
    let scene = args.window.of(scene, &args.scene)?;
    let rotation = scene.rotation();
    if rotation > LARGEST_ROTATION {
        return Err(Failure::BadInput(format!(
            "{}: [time] covers {rotation:.1e} rad of rotation: must be at most {LARGEST_ROTATION:.0e} rad for a list of every pulse; \
             shorten the span or select a window of it with --from and --to; `twofold timing` computes the pulses near given epochs",
            args.scene
        )));
    }
    if args.plan.explain {
        return print(&explained(&scene, &scene.plan(&[Output::Pulses])?));
    }
    let summary = write(&args.output, &scene, |writer, progress| write_pulses(&scene, writer, progress))?;
    let Some(summary) = summary else { return Ok(()) };
    for (beam, _) in summary.pulses.iter().enumerate().filter(|(_, pulses)| **pulses == 0) {
        note(&format!("no pulse of beam {}: the line of sight stays outside it", beam + 1));
    }
    for (beam, pulses, why) in &summary.without_turn {
        note(&format!(
            "turn and closest_approach are empty for {} of beam {beam}: turns cannot be counted ({why})",
            counted(*pulses, "whole pulse")
        ));
    }
    if let Some(time) = summary.first_grazing {
        note(&format!(
            "the line of sight grazes the edge of a beam {}, first at t = {time:?} {}; rounding decides whether there is a pulse \
             there, or a gap between two",
            counted(summary.grazings, "time"),
            scene.units.time_name
        ));
    }
    Ok(())
}
