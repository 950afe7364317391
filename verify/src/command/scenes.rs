//! `twofold scenes`.

use super::{Failure, print};
use crate::scene_file::{BUILT_IN, Scene};

pub(super) fn scenes() -> Result<(), Failure> {
    let width = BUILT_IN.iter().map(|scene| scene.name.len()).max().unwrap_or(0);
    let mut text = String::from("Built-in scenes, for `twofold run NAME`:\n\n");
    for built_in in BUILT_IN {
        let scene = Scene::from_toml(built_in.name, built_in.toml).map_err(|e| Failure::Failed(e.to_string()))?;
        text += &format!("  {:width$}  {}\n", built_in.name, scene.about);
    }
    text += "\nThe files are in verify/scenes; docs/scenes.md describes how to write your own.\n";
    print(&text)
}
