//! The file under which a covered text is reported.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use format::script_file::language;
use script::coverage::{CountedText, read_text};

/// The folder beside the report with copies of scripts that have no file.
const COPIES: &str = "coverage";
/// The name of a scene without a file.
const UNTITLED: &str = "untitled";

/// A text as it is shown.
pub(super) struct Place {
    /// Relative to the current folder where it is below that.
    pub path: PathBuf,
    pub text: Vec<u8>,
    /// No file has the text: a copy is to be written.
    pub is_copy: bool,
}

/// Finds the files of texts.
pub(super) struct Places {
    copies: PathBuf,
    tests: Vec<PathBuf>,
    /// Which texts have a name already.
    taken: BTreeMap<PathBuf, Vec<Vec<u8>>>,
}

impl Places {
    /// For a report in the file `report`; the files `tests` have no place in it.
    pub(super) fn new(report: &Path, tests: &[PathBuf]) -> Self {
        let copies = report.parent().unwrap_or(Path::new("")).join(COPIES);
        Self {
            copies,
            tests: tests.iter().filter_map(|test| below(test)).collect(),
            taken: BTreeMap::new(),
        }
    }

    /// The file of a text; None when it is not to be reported.
    pub(super) fn of(&mut self, text: &CountedText) -> Option<Place> {
        match text {
            CountedText::File(file) => {
                let path = below(file).filter(|path| !self.tests.contains(path))?;
                let text = read_text(&path)?;
                Some(Place {
                    path,
                    text,
                    is_copy: false,
                })
            }
            CountedText::Script { scene, path, text } => Some(self.of_script(scene, path, text)),
        }
    }

    /// The script of a scene that is a script is the scene's file itself.
    fn of_script(&mut self, scene: &str, path: &str, text: &[u8]) -> Place {
        let file = below(Path::new(scene));
        if let Some(file) = &file
            && (scene.ends_with(".lua") || scene.ends_with(".py"))
            && read_text(file).is_some_and(|code| code == text)
        {
            return Place {
                path: file.clone(),
                text: text.to_vec(),
                is_copy: false,
            };
        }
        let scene = file.or_else(|| Path::new(scene).file_name().map(PathBuf::from));
        let folder = self.copies.join(scene.unwrap_or_else(|| UNTITLED.into()));
        let extension = language(None, text).replace("python", "py");
        let path = self.name_for(&folder.join(file_name(path)), &extension, text);
        Place {
            path,
            text: text.to_vec(),
            is_copy: true,
        }
    }

    /// Two texts of one name, as when a test changes a script, get a number.
    fn name_for(&mut self, stem: &Path, extension: &str, text: &[u8]) -> PathBuf {
        let texts = self.taken.entry(stem.to_owned()).or_default();
        let number = texts
            .iter()
            .position(|known| known == text)
            .unwrap_or_else(|| {
                texts.push(text.to_vec());
                texts.len() - 1
            });
        let mut name = stem.as_os_str().to_owned();
        name.push(if number == 0 {
            format!(".{extension}")
        } else {
            format!("~{}.{extension}", number + 1)
        });
        name.into()
    }
}

/// A path below the current folder, relative to that; None when it is not below it.
fn below(path: &Path) -> Option<PathBuf> {
    let here = std::env::current_dir().ok()?.canonicalize().ok()?;
    let path = path.canonicalize().ok()?;
    path.strip_prefix(here)
        .ok()
        .filter(|path| *path != Path::new(""))
        .map(Path::to_owned)
}

/// The path of an object as that of a file. Copies of an object, `Robot[1]`, count as one.
fn file_name(path: &str) -> PathBuf {
    let parts = path.split('/').filter(|part| !part.is_empty()).map(|part| {
        let part = part.split('[').next().unwrap_or_default();
        let part: String = part
            .chars()
            .map(|c| {
                if c.is_alphanumeric() || "_-@.".contains(c) {
                    c
                } else {
                    '_'
                }
            })
            .collect();
        if part.chars().all(|c| c == '.') {
            "_".to_owned()
        } else {
            part
        }
    });
    let path: PathBuf = parts.collect();
    debug_assert!(
        path.components()
            .all(|part| matches!(part, Component::Normal(_))),
        "no part leads elsewhere"
    );
    path
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use super::{Places, below, file_name};
    use script::coverage::CountedText;

    fn script(scene: &str, path: &str, text: &str) -> CountedText {
        CountedText::Script {
            scene: scene.into(),
            path: path.into(),
            text: text.as_bytes().into(),
        }
    }

    #[test]
    fn scripts_of_scenes_get_files_below_the_folder_of_copies() {
        let mut places = Places::new(Path::new("out/lcov.info"), &[]);
        let mut path = |text| places.of(&text).expect("scripts have places").path;
        assert_eq!(
            path(script("", "/Robot/script", "a")),
            PathBuf::from("out/coverage/untitled/Robot/script.lua")
        );
        assert_eq!(
            path(script("/away/s.ttt", "/R", "a")),
            PathBuf::from("out/coverage/s.ttt/R.lua")
        );
        assert_eq!(
            path(script("/away/s.ttt", "/R[1]", "a")),
            PathBuf::from("out/coverage/s.ttt/R.lua")
        );
        assert_eq!(
            path(script("/away/s.ttt", "/R[2]", "b")),
            PathBuf::from("out/coverage/s.ttt/R~2.lua")
        );
    }

    #[test]
    fn only_files_below_the_current_folder_are_reported() {
        assert_eq!(
            below(Path::new("./src/../src/lib.rs")),
            Some("src/lib.rs".into())
        );
        assert_eq!(below(Path::new("/")), None);
        assert_eq!(below(Path::new("nowhere.lua")), None);
        let mut places = Places::new(Path::new("lcov.info"), &["src/coverage/place.rs".into()]);
        let mut place = |file: &str| {
            places
                .of(&CountedText::File(file.into()))
                .map(|place| place.path)
        };
        assert_eq!(place("./src/./coverage/place.rs"), None, "a test");
        assert_eq!(
            place("./src/coverage/mod.rs"),
            Some("src/coverage/mod.rs".into())
        );
    }

    #[test]
    fn no_name_leads_out_of_the_folder() {
        assert_eq!(file_name("/../a b/..[2]/x"), PathBuf::from("_/a_b/_/x"));
    }
}
