//! `twofold figures`.

use clap::Args;
use std::path::{Path, PathBuf};

use super::output_folder::OutputFolder;
use super::progress::on_all_processors;
use super::run::read_scene;
use super::{Failure, note, print, tell};
use crate::figures::{self, Figure, OF_A_SCENE, RECIPES, Recipe, Subject, literal};
use twofold_scene::scene_file::{Columns, did_you_mean, shortened};

#[derive(Args)]
pub(crate) struct FiguresArgs {
    /// Figures to draw, by name or by number of the paper's figure; all if none is named
    #[arg(value_name = "NAME")]
    pub(crate) names: Vec<String>,
    /// Folder for the files, created if it does not exist
    #[arg(long, value_name = "DIR", default_value = "figures")]
    pub(crate) out: PathBuf,
    /// Draw the figures of a motion for this built-in scene or scene file (TOML)
    #[arg(long, value_name = "SCENE")]
    pub(crate) scene: Option<String>,
    /// Replace files that exist
    #[arg(long)]
    pub(crate) force: bool,
    /// List the figures instead of drawing them
    #[arg(long)]
    pub(crate) list: bool,
}

pub(super) fn figures(args: &FiguresArgs) -> Result<(), Failure> {
    let known: &[Recipe] = if args.scene.is_some() { &OF_A_SCENE } else { &RECIPES };
    let mut chosen = chosen(known, &args.names)?;
    if args.list {
        return print(&list(&chosen));
    }
    let motions = match &args.scene {
        Some(scene) => vec![motion_of(scene)?],
        None => figures::examples().map_err(Failure::Failed)?.into(),
    };
    if let Some(scene) = &args.scene {
        leave_out_what_is_lacking(&mut chosen, scene, &motions[0], !args.names.is_empty())?;
    }
    let would_write = |file: &str| chosen.iter().any(|recipe| is_file_of(file, recipe.name));
    let folder = OutputFolder::at(&args.out, args.force, would_write)?;
    on_all_processors(
        &chosen,
        "figures",
        |recipe| recipe.name,
        |recipe| {
            let figure = recipe.draw(&motions).map_err(Failure::Failed)?;
            write(&figure, &folder)
        },
    )?;
    let files = folder.complete()?;
    let s = if chosen.len() == 1 { "" } else { "s" };
    tell(&format!("{}: {} figure{s}, {files} files\n", args.out.display(), chosen.len()))
}

fn motion_of(scene: &str) -> Result<Subject, Failure> {
    let read = read_scene(scene, Columns::Unused)?;
    let name = Path::new(scene).file_stem().map_or_else(|| scene.into(), |stem| stem.to_string_lossy());
    Subject::of_scene(&literal(&shortened(&name)), &read).map_err(Failure::Failed)
}

/// Omits the figures for which the scene lacks something; a figure requested by name is refused.
fn leave_out_what_is_lacking(
    chosen: &mut Vec<Recipe>,
    scene: &str,
    motion: &Subject,
    named: bool,
) -> Result<(), Failure> {
    for recipe in chosen.iter() {
        if let Some(lacking) = recipe.lacks(motion) {
            let name = recipe.name;
            if named {
                return Err(Failure::BadInput(format!(
                    "{scene}: the scene lacks {lacking}; there is no figure `{name}` without it"
                )));
            }
            note(&format!("no figure `{name}`: the scene lacks {lacking}"));
        }
    }
    chosen.retain(|recipe| recipe.lacks(motion).is_none());
    Ok(())
}

/// The requested figures, by name or by number of the paper's figure, in the order of the list; all if none is named.
fn chosen(known: &[Recipe], names: &[String]) -> Result<Vec<Recipe>, Failure> {
    let meant = |recipe: &Recipe, name: &String| {
        recipe.name == name || recipe.paper_figure.is_some_and(|number| number.to_string() == *name)
    };
    if let Some(unknown) = names.iter().find(|name| !known.iter().any(|recipe| meant(recipe, name))) {
        let all = known.iter().map(|recipe| recipe.name).collect::<Vec<_>>();
        let last = RECIPES.iter().filter_map(|recipe| recipe.paper_figure).max().unwrap_or(0);
        let numbers = match known.iter().any(|recipe| recipe.paper_figure.is_some()) {
            true => format!(", or 1 to {last}, the number of a figure of the paper"),
            false if unknown.parse::<i64>().is_ok() => {
                ". Numbers are those of the figures of the paper, which are drawn without --scene".to_owned()
            }
            false => String::new(),
        };
        return Err(Failure::BadInput(format!(
            "there is no figure `{unknown}`.{} Expected one of {}{numbers}.",
            did_you_mean(unknown, &all),
            all.join(", ")
        )));
    }
    let wanted = |recipe: &&Recipe| names.is_empty() || names.iter().any(|name| meant(recipe, name));
    Ok(known.iter().filter(wanted).copied().collect())
}

fn list(recipes: &[Recipe]) -> String {
    let width = recipes.iter().map(|recipe| recipe.name.len()).max().unwrap_or(0);
    let mut text = String::new();
    for recipe in recipes {
        let number = recipe.paper_figure.map_or(String::new(), |number| format!("Fig. {number}"));
        text += &format!("{:width$}  {number:7}  {}\n", recipe.name, recipe.summary);
    }
    text
}

/// Whether `file` is a name under which the figure `name` is written.
fn is_file_of(file: &str, name: &str) -> bool {
    let ending = file.strip_prefix(name).and_then(|rest| rest.strip_prefix('.'));
    ending.is_some_and(|ending| matches!(ending, "svg" | "png" | "md") || ending.ends_with("csv"))
}

fn write(figure: &Figure, folder: &OutputFolder) -> Result<(), Failure> {
    let name = &figure.name;
    folder.write(&format!("{name}.svg"), figure.svg.as_bytes())?;
    let png = figures::png(&figure.svg).map_err(|error| Failure::Failed(format!("{name}: {error}")))?;
    folder.write(&format!("{name}.png"), &png)?;
    for table in &figure.tables {
        folder.write(&figure.table_file(table), table.csv().as_bytes())?;
    }
    folder.write(&format!("{name}.md"), figure.description().as_bytes())
}
