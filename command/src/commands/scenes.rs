//! `twofold scenes`.

use super::{Failure, print};
use clap::Args;
use twofold_scene::scene_file::{BUILT_IN, BuiltIn, PULSARS, Scene, SceneError, TEMPLATES, did_you_mean, listed};
use twofold_scene::sweep::{SWEEPS, Sweep, SweepText};

#[derive(Args)]
pub(crate) struct ScenesArgs {
    /// Print the file of this built-in scene or sweep, as a template: `twofold scenes --print tp-2 > my-star.toml`
    #[arg(long, value_name = "NAME")]
    pub(crate) print: Option<String>,
}

pub(super) fn scenes(args: &ScenesArgs) -> Result<(), Failure> {
    if let Some(name) = &args.print {
        return print(file_called(name)?.toml);
    }
    let about_scene = |file: &BuiltIn| Scene::from_toml(file.name, file.toml).map(|scene| scene.about);
    let about_sweep = |file: &BuiltIn| {
        let text = SweepText::of(file.name, file.toml.to_owned())?;
        Sweep::new(&text).map(|sweep| sweep.about)
    };
    let mut text = String::from("Built-in scenes, for `twofold run NAME`:\n\n");
    text += &list(BUILT_IN, about_scene)?;
    text += "\nPulsars over decades, for `twofold timing NAME`:\n\n";
    text += &list(PULSARS, about_scene)?;
    text += "\nStars as files to start from:\n\n";
    text += &list(TEMPLATES, about_scene)?;
    text += "\nSweeps, as files to start from:\n\n";
    text += &list(SWEEPS, about_sweep)?;
    text += "\n`twofold scenes --print NAME > FILE` writes the file of one, to be changed; docs/scenes.md and docs/sweep.md describe the \
             formats.\n";
    print(&text)
}

fn all() -> impl Iterator<Item = &'static BuiltIn> {
    BUILT_IN.iter().chain(PULSARS).chain(TEMPLATES).chain(SWEEPS)
}

fn file_called(name: &str) -> Result<&'static BuiltIn, Failure> {
    all().find(|file| file.name == name).ok_or_else(|| {
        let names: Vec<_> = all().map(|file| file.name).collect();
        Failure::BadInput(format!("--print {name}: must be one of {}.{}", listed(&names), did_you_mean(name, &names)))
    })
}

fn list(files: &[BuiltIn], about: impl Fn(&BuiltIn) -> Result<String, SceneError>) -> Result<String, Failure> {
    let width = files.iter().map(|file| file.name.len()).max().unwrap_or(0);
    let mut text = String::new();
    for file in files {
        let about = about(file).map_err(|error| Failure::Failed(error.to_string()))?;
        text += &format!("  {:width$}  {about}\n", file.name);
    }
    Ok(text)
}
