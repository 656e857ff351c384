//! Where the files are that a description names.

use std::path::{Component, Path, PathBuf};

/// Where files are looked for.
#[derive(Debug, Clone, Default)]
pub struct Search {
    /// What `package://` is replaced by, if anything.
    pub replacement: Option<String>,
    /// The folders of packages, by name.
    pub packages: Vec<(String, PathBuf)>,
    /// Folders that contain packages, or `share` with packages.
    pub folders: Vec<PathBuf>,
    /// The folder of the description.
    pub beside: PathBuf,
}

/// A file that is nowhere.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("file '{uri}' not found{}", places(.tried))]
pub struct Unresolved {
    /// The file as the description names it.
    pub uri: String,
    /// Paths at which there is none.
    pub tried: Vec<PathBuf>,
}

fn places(tried: &[PathBuf]) -> String {
    let shown: Vec<String> = tried
        .iter()
        .take(4)
        .map(|path| path.display().to_string())
        .collect();
    match tried.len() {
        0 => String::new(),
        1..=4 => format!(" (looked for {})", shown.join(", ")),
        more => format!(
            " (looked for {}, and {} other places)",
            shown.join(", "),
            more - 4
        ),
    }
}

/// Places at which a file is looked for: the author of a description may choose how many folders are above it.
const MAX_CANDIDATES: usize = 200;

impl Search {
    /// Looks beside a file.
    pub fn beside(file: &Path) -> Self {
        Self {
            beside: file.parent().unwrap_or(Path::new("")).to_owned(),
            ..Self::default()
        }
    }

    /// Adds the folders of ROS: `ROS_PACKAGE_PATH`, `AMENT_PREFIX_PATH`, `GAZEBO_MODEL_PATH`, `SDF_PATH`. The caller says what variables contain.
    #[must_use]
    pub fn with_variables(mut self, variable: impl Fn(&str) -> Option<String>) -> Self {
        for name in [
            "ROS_PACKAGE_PATH",
            "AMENT_PREFIX_PATH",
            "GAZEBO_MODEL_PATH",
            "SDF_PATH",
        ] {
            let folders = variable(name).unwrap_or_default();
            self.folders.extend(
                folders
                    .split(':')
                    .filter(|folder| !folder.is_empty())
                    .map(PathBuf::from),
            );
        }
        self
    }

    /// The file that a name in the description stands for: the first that exists.
    ///
    /// # Errors
    ///
    /// If none of the possible places has it.
    pub fn find(&self, uri: &str, exists: &dyn Fn(&Path) -> bool) -> Result<PathBuf, Unresolved> {
        let mut tried = Vec::new();
        for place in self.places(uri) {
            if tried.len() >= MAX_CANDIDATES {
                break;
            }
            if tried.contains(&place) {
                continue;
            }
            if exists(&place) {
                return Ok(place);
            }
            tried.push(place);
        }
        Err(Unresolved {
            uri: uri.to_owned(),
            tried,
        })
    }

    fn places(&self, uri: &str) -> Vec<PathBuf> {
        let uri = uri.trim().replace('\\', "/");
        if let Some(path) = uri.strip_prefix("file://") {
            return self.plain(&percent_decoded(path));
        }
        match uri
            .strip_prefix("package://")
            .or_else(|| uri.strip_prefix("model://"))
        {
            Some(path) => self.in_package(&percent_decoded(path)),
            None if uri.contains("://") || uri.is_empty() => Vec::new(),
            None => self.plain(&uri),
        }
    }

    /// Beside the description, and beside the folders above it.
    fn plain(&self, path: &str) -> Vec<PathBuf> {
        let path = Path::new(path);
        if path.is_absolute() {
            return vec![path.to_owned()];
        }
        self.above()
            .map(|folder| normalized(&folder.join(path)))
            .collect()
    }

    fn in_package(&self, path: &str) -> Vec<PathBuf> {
        if let Some(replacement) = &self.replacement {
            return vec![normalized(
                &self.beside.join(format!("{replacement}{path}")),
            )];
        }
        let (package, rest) = path.split_once('/').unwrap_or((path, ""));
        let named = self
            .packages
            .iter()
            .filter(|(name, _)| name == package)
            .map(|(_, folder)| folder.join(rest));
        let known = self
            .folders
            .iter()
            .flat_map(|folder| below(folder, package, rest));
        let above = self.above().flat_map(|folder| below(folder, package, rest));
        // Packages that were copied under another name.
        let renamed = self.above().map(|folder| folder.join(rest));
        named
            .chain(known)
            .chain(above)
            .chain(renamed)
            .map(|place| normalized(&place))
            .collect()
    }

    fn above(&self) -> impl Iterator<Item = &Path> {
        self.beside.ancestors()
    }
}

/// Where a package may be in a folder: inside, inside of `share`, or the folder itself.
fn below(folder: &Path, package: &str, rest: &str) -> Vec<PathBuf> {
    let mut places = vec![
        folder.join(package).join(rest),
        folder.join("share").join(package).join(rest),
    ];
    if folder.file_name().is_some_and(|name| name == package) {
        places.push(folder.join(rest));
    }
    places
}

/// Without `.` and `..`, so that the same place has one name.
fn normalized(path: &Path) -> PathBuf {
    let mut result = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir
                if matches!(result.components().next_back(), Some(Component::Normal(_))) =>
            {
                result.pop();
            }
            part => result.push(part),
        }
    }
    result
}

fn percent_decoded(text: &str) -> String {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let [first, tail @ ..] = rest {
        let code = tail
            .get(..2)
            .and_then(|hex| std::str::from_utf8(hex).ok())
            .and_then(|hex| u8::from_str_radix(hex, 16).ok());
        match code {
            Some(byte) if *first == b'%' => {
                bytes.push(byte);
                rest = &tail[2..];
            }
            _ => {
                bytes.push(*first);
                rest = tail;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn find(search: &Search, uri: &str, existing: &str) -> Option<String> {
        search
            .find(uri, &|path| path == Path::new(existing))
            .ok()
            .map(|path| path.display().to_string())
    }

    #[test]
    fn packages_are_found_above_the_file_in_search_paths_and_by_name() {
        let beside = Search::beside(Path::new("/ws/src/arm/urdf/arm.urdf"));
        assert_eq!(
            find(
                &beside,
                "package://arm/meshes/a.stl",
                "/ws/src/arm/meshes/a.stl"
            )
            .as_deref(),
            Some("/ws/src/arm/meshes/a.stl")
        );
        assert_eq!(
            find(&beside, "package://hand/b.stl", "/ws/src/hand/b.stl").as_deref(),
            Some("/ws/src/hand/b.stl")
        );
        let variables =
            |name: &str| (name == "AMENT_PREFIX_PATH").then(|| "/opt/ros/jazzy:".to_owned());
        let ros = beside.clone().with_variables(variables);
        assert_eq!(
            find(
                &ros,
                "package://hand/b.stl",
                "/opt/ros/jazzy/share/hand/b.stl"
            )
            .as_deref(),
            Some("/opt/ros/jazzy/share/hand/b.stl")
        );
        let named = Search {
            packages: vec![("hand".into(), "/elsewhere/h".into())],
            ..beside
        };
        assert_eq!(
            find(&named, "package://hand/b.stl", "/elsewhere/h/b.stl").as_deref(),
            Some("/elsewhere/h/b.stl")
        );
    }

    #[test]
    fn a_replacement_takes_the_place_of_the_scheme() {
        let search = Search {
            replacement: Some("/data/".into()),
            ..Search::beside(Path::new("/x/y.urdf"))
        };
        assert_eq!(
            find(&search, "package://arm/a.stl", "/data/arm/a.stl").as_deref(),
            Some("/data/arm/a.stl")
        );
        assert_eq!(find(&search, "package://arm/a.stl", "/x/a.stl"), None);
    }

    #[test]
    fn other_names_are_relative_to_the_file_or_absolute() {
        let search = Search::beside(Path::new("/ws/arm/urdf/arm.urdf"));
        assert_eq!(
            find(&search, "..\\meshes\\a.stl", "/ws/arm/meshes/a.stl").as_deref(),
            Some("/ws/arm/meshes/a.stl")
        );
        assert_eq!(
            find(&search, "file:///tmp/a%20b.stl", "/tmp/a b.stl").as_deref(),
            Some("/tmp/a b.stl")
        );
        assert_eq!(find(&search, "http://x/a.stl", "/ws/arm/urdf/a.stl"), None);
    }

    #[test]
    fn an_error_names_the_places() {
        let error = Search::beside(Path::new("/a/b.urdf"))
            .find("c.stl", &|_| false)
            .unwrap_err();
        assert_eq!(
            error.to_string(),
            "file 'c.stl' not found (looked for /a/c.stl, /c.stl)"
        );
    }
}
