//! `twofold scenes`.

use super::{Failure, print};
use crate::scene_file::{BUILT_IN, BuiltIn, PULSARS, Scene};

pub(super) fn scenes() -> Result<(), Failure> {
    let mut text = String::from("Built-in scenes, for `twofold run NAME`:\n\n");
    text += &list(BUILT_IN)?;
    text += "\nPulsars over decades, for `twofold timing NAME`:\n\n";
    text += &list(PULSARS)?;
    text += "\nThe files are in verify/scenes; docs/scenes.md describes how to write your own.\n";
    print(&text)
}

fn list(scenes: &[BuiltIn]) -> Result<String, Failure> {
    let width = scenes.iter().map(|scene| scene.name.len()).max().unwrap_or(0);
    let mut text = String::new();
    for built_in in scenes {
        let scene = Scene::from_toml(built_in.name, built_in.toml).map_err(|e| Failure::Failed(e.to_string()))?;
        text += &format!("  {:width$}  {}\n", built_in.name, scene.about);
    }
    Ok(text)
}
