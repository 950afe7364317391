//! The section `[output]`.

use twofold::plan::{Method, Output};

use super::Scene;
use super::error::Fault;
use super::section::Section;
use crate::columns::{self, ColumnGroup};

pub(super) const DEFAULT_ACCURACY: f64 = 1e-13;

/// Reads columns and accuracy into a scene that is complete otherwise. Columns that are not `used` need nothing of the
/// scene, which keeps those it has.
pub(super) fn read(section: &Section<'_>, scene: &mut Scene, used: bool) -> Result<(), Fault> {
    section.only(&["columns", "accuracy", "method"])?;
    read_accuracy_and_method(section, scene)?;
    let Some(list) = section.optional("columns") else { return Ok(()) };
    let names: Vec<_> = columns::ALL.iter().map(|group| group.name).collect();
    let allowed = format!("a list of different names out of \"{}\"", names.join("\", \""));
    let entries = list.list(&allowed)?;
    if entries.is_empty() {
        return Err(list.refuse(&allowed));
    }
    let mut wanted: Vec<&'static ColumnGroup> = Vec::new();
    for entry in &entries {
        let name = entry.word(&names)?;
        let Some(group) = columns::named(name) else { return Err(entry.refuse(&allowed)) };
        if wanted.contains(&group) {
            return Err(entry.refuse(&allowed));
        }
        if used {
            group.available_in(scene).map_err(|why| entry.refuse_because(&why))?;
        }
        wanted.push(group);
    }
    if used {
        scene.columns = columns::in_order(&wanted);
    }
    Ok(())
}

/// Reads the keys `accuracy` and `method` into a scene, which keeps what it has where they are not given.
pub(crate) fn read_accuracy_and_method(section: &Section<'_>, scene: &mut Scene) -> Result<(), Fault> {
    if let Some(entry) = section.optional("accuracy") {
        scene.accuracy = entry.number_where("a number from 1e-14 to 1e-2", |x| (1e-14..=1e-2).contains(&x))?;
    }
    if let Some(entry) = section.optional("method") {
        let name = entry.word(&Method::ALL.map(Method::name))?;
        scene.choose_method(name).map_err(|why| entry.refuse_because(&why))?;
    }
    Ok(())
}

impl Scene {
    /// Forces the method called `name`, in place of the cheapest one.
    ///
    /// # Errors
    /// A sentence about a name that is unknown, or about why the scene does not allow the method.
    pub fn choose_method(&mut self, name: &str) -> Result<(), String> {
        let known = Method::ALL.map(Method::name);
        let Some(method) = Method::named(name) else {
            let guess = super::nearest(name, &known).map(|near| format!(" Did you mean `{near}`?"));
            return Err(format!(
                "`{name}` is no method; allowed are {}.{}",
                super::section::listed(&known),
                guess.unwrap_or_default()
            ));
        };
        self.method = Some(method);
        self.plan(&[Output::EquatorialAxis])
            .map(|_| ())
            .map_err(|why| format!("the scene does not allow this method: {why}"))
    }

    /// Replaces the columns by the groups called `names`.
    ///
    /// # Errors
    /// A sentence about a name that is unknown or comes twice, or about a group that needs what the scene lacks.
    pub fn choose_columns(&mut self, names: &[&str]) -> Result<(), String> {
        let mut wanted: Vec<&'static ColumnGroup> = Vec::new();
        for &name in names {
            let Some(group) = columns::named(name) else {
                let known: Vec<_> = columns::ALL.iter().map(|group| group.name).collect();
                let guess = super::nearest(name, &known).map(|near| format!(" Did you mean `{near}`?"));
                return Err(format!(
                    "`{name}` is no group of columns; allowed are {}.{}",
                    super::section::listed(&known),
                    guess.unwrap_or_default()
                ));
            };
            if wanted.contains(&group) {
                return Err(format!("`{name}` comes twice"));
            }
            group.available_in(self).map_err(|why| format!("`{name}`: {why}"))?;
            wanted.push(group);
        }
        if wanted.is_empty() {
            return Err("no group of columns is named".into());
        }
        self.columns = columns::in_order(&wanted);
        Ok(())
    }
}
