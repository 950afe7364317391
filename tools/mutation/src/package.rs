//! The packages whose sources are made wrong, each with the packages whose tests are run against it.

/// A package of the workspace.
pub struct Package {
    pub name: &'static str,
    /// Folder of its sources, below the tree.
    pub sources: &'static str,
    /// Packages whose tests reach it; none of the module for Python, which pytest tests.
    pub tested_by: &'static [&'static str],
    /// Features that it is built with, beside the default ones.
    pub features: &'static [&'static str],
}

const PACKAGES: [Package; 5] = [
    Package { name: "twofold", sources: "src/", tested_by: &["twofold"], features: &[] },
    Package {
        name: "twofold-scene",
        sources: "scene/src/",
        tested_by: &["twofold-scene", "twofold-command"],
        features: &["twofold-scene/parquet"],
    },
    Package {
        name: "twofold-bench",
        sources: "tools/bench/src/",
        tested_by: &["twofold-bench", "twofold-command"],
        features: &[],
    },
    Package { name: "twofold-command", sources: "command/src/", tested_by: &["twofold-command"], features: &[] },
    Package { name: "twofold-python", sources: "python/src/", tested_by: &[], features: &[] },
];

impl Package {
    /// The package of the files that begin in one of these ways, which are separated by spaces.
    pub fn of_all(prefixes: &str) -> Result<&'static Self, String> {
        let mut packages = prefixes.split_whitespace().map(Self::of).collect::<Result<Vec<_>, _>>()?;
        packages.dedup_by_key(|package| package.name);
        match packages[..] {
            [package] => Ok(package),
            _ => Err(format!("`{prefixes}`: not in one package")),
        }
    }

    /// The package with a file, or with files that begin so.
    fn of(file: &str) -> Result<&'static Self, String> {
        let found = PACKAGES.iter().find(|package| file.starts_with(package.sources));
        found.ok_or_else(|| {
            let all: Vec<&str> = PACKAGES.iter().map(|package| package.sources).collect();
            format!("{file}: not in one of {}", all.join(", "))
        })
    }

    /// The module path of a file, such as `crate::star::deformation` for `src/star/deformation.rs`.
    pub fn module_of(&self, file: &str) -> String {
        let parts: Vec<&str> = file.trim_start_matches(self.sources).trim_end_matches(".rs").split('/').collect();
        let kept = parts.iter().filter(|part| !["mod", "lib"].contains(part));
        std::iter::once("crate").chain(kept.copied()).collect::<Vec<_>>().join("::")
    }
}

/// Whether a file begins in one of these ways, which are separated by spaces.
pub fn is_among(file: &str, prefixes: &str) -> bool {
    prefixes.split_whitespace().any(|prefix| file.starts_with(prefix))
}
