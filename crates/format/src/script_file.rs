//! Which files are scripts, and of which language: name and content decide together, so that nothing else is run by mistake.
//!
//! Scenes and models are recognised by their content alone ([`super::scene_file::is_scene`]); this is about the rest.

use std::path::Path;

/// Why a file is no script.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NotAScript {
    /// There is nothing in it.
    #[error("the file is empty")]
    Empty,
    /// Its name ends as those of scenes and models do, but it is none.
    #[error("it is not a scene or model of CoppeliaSim, whatever its name says")]
    NotAScene,
    /// A robot's description that has to be expanded.
    #[error(
        "it is a xacro file. Expand it first: xacro FILE > robot.urdf (pip install xacro, or a ROS installation)"
    )]
    Xacro,
    /// Triangles in a format of meshes.
    #[error("it holds a mesh, and no scene")]
    Mesh,
    /// A text of a scene that was unpacked into a folder.
    #[error("it is a part of an unpacked scene: name the folder instead")]
    PartOfFolder,
    /// Bytes that are no text.
    #[error("it is neither a script in Lua or Python nor a scene or model of CoppeliaSim")]
    Binary,
}

/// Checks that the name is not that of a robot's description that has to be expanded first: it is XML, as scenes may be.
///
/// # Errors
/// [`NotAScript::Xacro`].
pub fn check_no_xacro(path: &Path) -> Result<(), NotAScript> {
    let is_xacro = path
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("xacro"));
    if is_xacro {
        Err(NotAScript::Xacro)
    } else {
        Ok(())
    }
}

/// Checks a file that is not a scene or model.
///
/// # Errors
/// When its name or its content says that it is no script.
pub fn check(path: &Path, content: &[u8]) -> Result<(), NotAScript> {
    let name = path
        .file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase();
    let ends_with = |endings: &[&str]| endings.iter().any(|ending| name.ends_with(ending));
    if ends_with(&[".lua", ".py"]) {
        return Ok(());
    }
    if content.is_empty() {
        return Err(NotAScript::Empty);
    }
    if ends_with(&[".ttt", ".ttm", ".xml"]) {
        return Err(NotAScript::NotAScene);
    }
    check_no_xacro(path)?;
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

/// The language of a script: that of its file's name, else what its first line says.
pub fn language(path: Option<&Path>, text: &[u8]) -> &'static str {
    let extension = path
        .and_then(Path::extension)
        .map(|extension| extension.to_string_lossy().to_lowercase());
    let first_line = text.split(|&byte| byte == b'\n').next().unwrap_or_default();
    match extension.as_deref() {
        Some("py") => "python",
        Some("lua") => "lua",
        _ if first_line.trim_ascii() == b"#python" => "python",
        _ => "lua",
    }
}

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
        assert_eq!(
            refusal("x.urdf.xacro", b"<robot/>"),
            Some(NotAScript::Xacro)
        );
        assert_eq!(refusal("x.stl", b"solid x"), Some(NotAScript::Mesh));
        assert_eq!(
            refusal("x/scene.json", b"{}"),
            Some(NotAScript::PartOfFolder)
        );
        for name in ["x.ttt", "x.xacro", "x"] {
            assert_eq!(refusal(name, b""), Some(NotAScript::Empty), "{name}");
        }
    }

    #[test]
    fn other_names_are_scripts_if_they_hold_text() {
        assert_eq!(refusal("scene", b"print(1)"), None);
        assert_eq!(refusal("scene.txt", "print('ü')".as_bytes()), None);
        assert_eq!(
            refusal("scene", b"\x1bLua\x54\x00"),
            Some(NotAScript::Binary)
        );
        assert_eq!(refusal("scene", b"\xff\xfe"), Some(NotAScript::Binary));
    }

    #[test]
    fn a_language_is_in_the_name_or_in_the_first_line() {
        for (name, text, expected) in [
            ("a/x.py", &b""[..], "python"),
            ("x.PY", b"print(1)", "python"),
            ("x.lua", b"#python\n", "lua"),
            ("x.txt", b"#python \r\nprint(1)", "python"),
            ("x", b"-- python", "lua"),
            ("", b"#python", "python"),
        ] {
            assert_eq!(
                language(Some(Path::new(name)).filter(|_| !name.is_empty()), text),
                expected,
                "{name}"
            );
        }
    }

    #[test]
    fn lua_files_hold_any_bytes() {
        assert_eq!(refusal("empty.lua", b""), None);
        assert_eq!(refusal("latin.lua", b"print('\xfc')"), None);
    }
}
