//! Which files are Lua scripts: name and content decide together, so that nothing else is run as Lua by mistake.
//!
//! Scenes and models are recognised by their content alone ([`super::scene_file::is_scene`]); this is about the rest.

use std::path::Path;

/// Why a file is no script.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NotAScript {
    #[error("the file is empty")]
    Empty,
    #[error("it is not a scene or model of CoppeliaSim, whatever its name says")]
    NotAScene,
    #[error(
        "it is a Python program, and scenes are scripted in Lua; Python programs control a simulator through the remote API (swanilda serve, docs/REMOTE_API.md)"
    )]
    Python,
    #[error("robots described in {0} cannot be imported yet (docs/PLUGINS.md)")]
    Robot(&'static str),
    #[error("it holds a mesh, and no scene")]
    Mesh,
    #[error("it is a part of an unpacked scene: name the folder instead")]
    PartOfFolder,
    #[error("it is neither a Lua script nor a scene or model of CoppeliaSim")]
    Binary,
}

/// Checks that the name is not that of a robot's description: some are XML, as scenes may be.
///
/// # Errors
/// [`NotAScript::Robot`].
pub fn check_no_robot(path: &Path) -> Result<(), NotAScript> {
    let name = path.to_string_lossy().to_lowercase();
    let found = ROBOTS.iter().find(|(ending, _)| name.ends_with(ending));
    found.map_or(Ok(()), |(_, format)| Err(NotAScript::Robot(format)))
}

/// Checks a file that is not a scene or model.
///
/// # Errors
/// When its name or its content says that it is no Lua script.
pub fn check(path: &Path, content: &[u8]) -> Result<(), NotAScript> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    let ends_with = |endings: &[&str]| endings.iter().any(|ending| name.ends_with(ending));
    if name.ends_with(".lua") {
        return Ok(());
    }
    if content.is_empty() {
        return Err(NotAScript::Empty);
    }
    if ends_with(&[".ttt", ".ttm", ".xml"]) {
        return Err(NotAScript::NotAScene);
    }
    if ends_with(&[".py", ".pyw"]) {
        return Err(NotAScript::Python);
    }
    check_no_robot(path)?;
    if ends_with(&[".obj", ".stl", ".dae", ".ply", ".gltf", ".glb"]) {
        return Err(NotAScript::Mesh);
    }
    if name == "scene.json" {
        return Err(NotAScript::PartOfFolder);
    }
    if content.contains(&0) || std::str::from_utf8(content).is_err() {
        return Err(NotAScript::Binary);
    }
    Ok(())
}

/// Descriptions of robots, by the endings of their files.
const ROBOTS: [(&str, &str); 4] = [(".urdf", "URDF"), (".xacro", "URDF"), (".sdf", "SDF"), (".mjcf", "MJCF")];

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(name: &str, content: &[u8]) -> Option<NotAScript> {
        check(Path::new(name), content).err()
    }

    #[test]
    fn names_of_other_kinds_are_no_scripts() {
        assert_eq!(refusal("r.ttt", b"print(1)"), Some(NotAScript::NotAScene));
        assert_eq!(refusal("a/R.TTM", b"\x8f\x00"), Some(NotAScript::NotAScene));
        assert_eq!(refusal("x.py", b"print(1)"), Some(NotAScript::Python));
        assert_eq!(refusal("x.urdf", b"<robot/>"), Some(NotAScript::Robot("URDF")));
        assert_eq!(refusal("x.stl", b"solid x"), Some(NotAScript::Mesh));
        assert_eq!(refusal("x/scene.json", b"{}"), Some(NotAScript::PartOfFolder));
        for name in ["x.ttt", "x.urdf", "x.py", "x"] {
            assert_eq!(refusal(name, b""), Some(NotAScript::Empty), "{name}");
        }
    }

    #[test]
    fn other_names_are_scripts_if_they_hold_text() {
        assert_eq!(refusal("scene", b"print(1)"), None);
        assert_eq!(refusal("scene.txt", "print('ü')".as_bytes()), None);
        assert_eq!(refusal("scene", b"\x1bLua\x54\x00"), Some(NotAScript::Binary));
        assert_eq!(refusal("scene", b"\xff\xfe"), Some(NotAScript::Binary));
    }

    #[test]
    fn lua_files_hold_any_bytes() {
        assert_eq!(refusal("empty.lua", b""), None);
        assert_eq!(refusal("latin.lua", b"print('\xfc')"), None);
    }
}
