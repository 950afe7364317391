//! Parameters by their names.

use pyo3::PyResult;
use twofold::inference::Unknown;
use twofold_scene::scene_file::{did_you_mean, listed};

use crate::error::raised;

/// The parameter called `name`.
pub fn named<U: Unknown>(name: &str, all: &[U]) -> PyResult<U> {
    all.iter().copied().find(|unknown| unknown.key() == name).ok_or_else(|| {
        let names: Vec<_> = all.iter().map(|unknown| unknown.key()).collect();
        raised(format!("`{name}` is no parameter; allowed are {}.{}", listed(&names), did_you_mean(name, &names)))
    })
}

/// The parameters called `names`, each once.
pub fn all_named<U: Unknown>(names: &[String], all: &[U]) -> PyResult<Vec<U>> {
    let mut found = Vec::new();
    for name in names {
        let unknown = named(name, all)?;
        if found.contains(&unknown) {
            return Err(raised(format!("`{name}` is named twice: allowed is once")));
        }
        found.push(unknown);
    }
    Ok(found)
}
