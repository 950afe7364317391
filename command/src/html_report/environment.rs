//! Time and system of the report. It names no person, machine or folder.

use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::{Duration, SystemTime};

/// Facts about the run with their names, in the order of the report.
pub type Environment = Vec<(&'static str, String)>;

/// Of this process, now.
pub fn environment() -> Environment {
    let mut facts = vec![("Version", concat!("twofold ", env!("CARGO_PKG_VERSION")).to_owned())];
    facts.extend(source().map(|commit| ("Source", commit)));
    let optimised = if cfg!(debug_assertions) { "with debug assertions" } else { "release" };
    facts.extend([
        ("Compiler", twofold_scene::COMPILER.to_owned()),
        ("Target", format!("{}, {optimised}", twofold_scene::TARGET)),
        ("Processors", thread::available_parallelism().map_or_else(|_| "unknown".to_owned(), |n| n.to_string())),
        ("Date and time", date_and_time(SystemTime::now())),
    ]);
    facts
}

/// Version, source and date in a sentence.
pub(super) fn brief(facts: &Environment) -> String {
    let is_brief = |name: &str| ["Version", "Source", "Date and time"].contains(&name);
    let facts: Vec<_> = facts.iter().filter(|(name, _)| is_brief(name)).map(|(_, fact)| fact.as_str()).collect();
    format!("{}.", facts.join(", "))
}

/// The date in UTC, if the clock is plausible: a machine may start in 1969 or in the year 10000.
fn date_and_time(now: SystemTime) -> String {
    const YEAR_10000: Duration = Duration::from_secs(253_402_300_800);
    match now.duration_since(SystemTime::UNIX_EPOCH) {
        Ok(since) if since < YEAR_10000 => {
            humantime::format_rfc3339_seconds(now).to_string().replace(['T', 'Z'], " ") + "UTC"
        }
        _ => "unknown: the clock of this machine is outside the years 1970 to 9999".to_owned(),
    }
}

/// The present commit of the folder in which this was built, if that folder still exists and is under git.
fn source() -> Option<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let git = |args: &[&str]| {
        let output = Command::new("git").arg("-C").arg(folder).args(args).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    // The commit of another repository around an unpacked copy does not count.
    git(&["ls-files", "--error-unmatch", "Cargo.toml"])?;
    let commit = git(&["rev-parse", "HEAD"])?;
    let changes = git(&["status", "--porcelain", "--untracked-files=no", "--", ":/"])?;
    Some(in_words(&commit, &changes))
}

fn in_words(commit: &str, changes: &str) -> String {
    let changes = if changes.is_empty() { "" } else { ", with changes not committed," };
    format!("source folder at commit {commit}{changes} when the report was made")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_that_are_not_committed_are_told() {
        assert_eq!(in_words("61a92c83", ""), "source folder at commit 61a92c83 when the report was made");
        let told = in_words("61a92c83", " M src/lib.rs");
        assert_eq!(told, "source folder at commit 61a92c83, with changes not committed, when the report was made");
    }

    /// Debug assertions are evaluated in a build that has them, and in no other.
    #[test]
    fn the_build_is_told_as_it_is() {
        let mut are_checked = false;
        debug_assert!({
            are_checked = true;
            are_checked
        });
        let facts = environment();
        let target = &facts.iter().find(|(name, _)| *name == "Target").expect("a target").1;
        assert_eq!(
            [target.ends_with("with debug assertions"), target.ends_with("release")],
            [are_checked, !are_checked]
        );
    }

    #[test]
    fn any_clock_is_told() {
        let at = |seconds| date_and_time(SystemTime::UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(at(0), "1970-01-01 00:00:00 UTC");
        assert_eq!(at(253_402_300_799), "9999-12-31 23:59:59 UTC");
        assert!(at(253_402_300_800).starts_with("unknown"));
        assert!(date_and_time(SystemTime::UNIX_EPOCH - Duration::from_secs(1)).starts_with("unknown"));
    }
}
