//! `sim.*`: scene and model files.
//!
//! A scene is a file of CoppeliaSim, or a Lua file on top of the default scene, or the default scene alone.

use std::path::{Component, Path, PathBuf};

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use format::robot_file::RobotFile;
use format::scene_file::{SceneFile, read_file};
use format::scene_input::SceneInput;
use scene::{Data, Handle, SceneError, special};
use script::log::verbosity;
use script::{SceneSource, readable_bytes};

pub(crate) const FUNCTIONS: &[ApiFn] =
    functions![load_scene, save_scene, close_scene, load_model, save_model];

/// The suffix of a file name that loads a scene in addition to the current one.
const KEEP_CURRENT: &str = "@keepCurrent";

/// A text as long as this is a file, not its name.
const MAX_NAME_LENGTH: usize = 1000;

/// Replaces the scene. For add-ons and the sandbox, while the simulation is stopped.
///
/// @param filenameOrBuffer a `.ttt` or `.simscene.xml` file or its bytes; a folder that `swanilda unpack` made; a `.lua` file, whose text becomes a
/// customization script of the default scene; empty for the default scene alone
/// @return result 1
#[api("sim.loadScene")]
fn load_scene(cx: &mut Cx, filename_or_buffer: Data) -> Result<i64> {
    let (source, path) = match FileOrBytes::new(filename_or_buffer)? {
        FileOrBytes::Name(name) if name.ends_with(KEEP_CURRENT) => {
            return Err(ApiError::Other(
                "scenes beside the current one (@keepCurrent) are not implemented in Swanilda."
                    .into(),
            ));
        }
        FileOrBytes::Name(name) if name.is_empty() => (SceneSource::Default, None),
        FileOrBytes::Name(name) => {
            let name = located(cx, &name);
            (named_scene(cx, &name)?, Some(absolute(cx, &name)))
        }
        FileOrBytes::Bytes(bytes) => (scene_source(cx, "the buffer", bytes, None)?, None),
    };
    cx.switch_scene(source, path)?;
    Ok(1)
}

/// Adds a model to the scene, where it was saved.
///
/// @param filenameOrBuffer a `.ttm` or `.simmodel.xml` file or its bytes, a folder that `swanilda unpack` made, or a robot in URDF, SDF or MJCF; with `--resources DIR` also a
/// file below DIR, such as `models/robots/mobile/dr12.ttm`
/// @param onlyThumbnails true raises an error: thumbnails are not implemented
/// @return objectHandle the base of the model
#[api("sim.loadModel")]
fn load_model(
    cx: &mut Cx,
    filename_or_buffer: Data,
    #[default(false)] only_thumbnails: bool,
) -> Result<i64> {
    if only_thumbnails {
        return Err(ApiError::Other(
            "thumbnails of models are not implemented in Swanilda.".into(),
        ));
    }
    let file = match FileOrBytes::new(filename_or_buffer)? {
        FileOrBytes::Name(name) => named_model(cx, &located(cx, &name))?,
        FileOrBytes::Bytes(bytes) => scene_file(cx, "the buffer", &bytes, None)?,
    };
    let root = cx.load_model(file)?;
    Ok(root.map_or(special::WORLD, Handle::raw))
}

/// Writes the scene to a file, which becomes the scene's, or returns its bytes. CoppeliaSim reads them since 4.5.1.
///
/// @param filename a `.ttt` file, or a `.simscene.xml` file, with `@simpleXml` behind it for the simple variant; nothing for the bytes
/// @return result 1, or a buffer with the bytes
#[api("sim.saveScene")]
fn save_scene(cx: &mut Cx, #[default(None)] filename: Option<String>) -> Result<Data> {
    let Some(filename) = filename else {
        return Ok(Data::Buffer(readable_bytes(&cx.scene_in_memory()?, None)?));
    };
    cx.save_scene(&filename)?;
    Ok(Data::Int(1))
}

/// Writes a model to a file, or returns its bytes. It is saved with its pose in the world.
///
/// @param modelBaseHandle an object that is marked as the base of a model
/// @param filename a `.ttm` file, or a `.simmodel.xml` file, with `@simpleXml` behind it for the simple variant; nothing for the bytes
/// @return result 1, or a buffer with the bytes
#[api("sim.saveModel")]
fn save_model(
    cx: &mut Cx,
    model_base_handle: Handle,
    #[default(None)] filename: Option<String>,
) -> Result<Data> {
    if !cx.scene().object(model_base_handle)?.is_model() {
        return Err(SceneError::NotAModel.into());
    }
    let file = cx.model_file(model_base_handle)?;
    let Some(filename) = filename else {
        return Ok(Data::Buffer(readable_bytes(&file, None)?));
    };
    cx.save_model(&file, &filename)?;
    Ok(Data::Int(1))
}

enum FileOrBytes {
    Name(String),
    Bytes(Vec<u8>),
}

impl FileOrBytes {
    fn new(value: Data) -> Result<Self> {
        match value {
            Data::Text(text) if text.len() < MAX_NAME_LENGTH => {
                Ok(Self::Name(String::from_utf8_lossy(&text).into_owned()))
            }
            Data::Text(bytes) | Data::Buffer(bytes) => Ok(Self::Bytes(bytes)),
            // As for any text, a number is one.
            Data::Int(number) => Ok(Self::Name(number.to_string())),
            _ => Err(ApiError::NotA {
                position: 1,
                expected: "string/buffer",
            }),
        }
    }
}

fn read(cx: &Cx, name: &str) -> Result<Vec<u8>> {
    cx.permissions().check_read(Path::new(name))?;
    let read = cx.permissions().read_checked(Path::new(name));
    read.map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => {
            cx.note_missing_file(name);
            ApiError::Other("file does not exist.".into())
        }
        _ => ApiError::Other(format!("'{name}' could not be read: {error}.")),
    })
}

/// A relative name that is no file here is one of the user's installation of CoppeliaSim.
fn located(cx: &Cx, name: &str) -> String {
    let installed = cx
        .options()
        .resources
        .as_ref()
        .and_then(|resources| installed_file(resources, name));
    let is_there =
        |path: &Path| cx.permissions().check_read(path).is_ok() && cx.permissions().exists(path);
    match installed.filter(|path| !is_there(Path::new(name)) && is_there(path)) {
        Some(path) => path.to_string_lossy().into_owned(),
        None => name.to_owned(),
    }
}

/// Where an installation has a file, for names that do not lead out of it.
fn installed_file(resources: &Path, name: &str) -> Option<PathBuf> {
    let is_inside = Path::new(name)
        .components()
        .all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    is_inside.then(|| resources.join(name))
}

fn named_scene(cx: &Cx, name: &str) -> Result<SceneSource> {
    if is_folder(cx, name)? {
        return Ok(SceneSource::File(Box::new(input(cx, name)?)));
    }
    scene_source(cx, name, read(cx, name)?, folder_of(name))
}

fn named_model(cx: &Cx, name: &str) -> Result<SceneFile> {
    let is_robot = RobotFile::is_one(Path::new(name), cx.permissions());
    if is_folder(cx, name)? || is_robot && cx.permissions().exists(Path::new(name)) {
        input(cx, name)
    } else {
        scene_file(cx, name, &read(cx, name)?, folder_of(name))
    }
}

fn is_folder(cx: &Cx, name: &str) -> Result<bool> {
    cx.permissions().check_read(Path::new(name))?;
    Ok(cx.permissions().is_dir(Path::new(name)))
}

/// A folder made by `swanilda unpack`, or a robot, of which the log says what was guessed.
fn input(cx: &Cx, name: &str) -> Result<SceneFile> {
    match SceneInput::read(Path::new(name), cx.permissions()).map_err(ApiError::Other)? {
        SceneInput::File(file) => {
            for message in file.messages() {
                let text = format!("{name}: {message}");
                cx.env().log(verbosity::SCRIPT_WARNINGS, &text);
            }
            file.scene()
                .map_err(|error| ApiError::Other(format!("{name}: {error}")))
        }
        SceneInput::Script(_) => Err(ApiError::Other(format!("{name} is no scene."))),
    }
}

/// A scene of CoppeliaSim is known by its bytes, one that is a script by its name.
fn scene_source(cx: &Cx, name: &str, bytes: Vec<u8>, folder: Option<&Path>) -> Result<SceneSource> {
    match Path::new(name)
        .extension()
        .and_then(|extension| extension.to_str())
    {
        Some("lua") => Ok(SceneSource::Script {
            code: bytes,
            python_file: None,
        }),
        Some("py") => Ok(SceneSource::Script {
            code: bytes,
            python_file: Some(absolute(cx, name)),
        }),
        _ => Ok(SceneSource::File(Box::new(scene_file(
            cx, name, &bytes, folder,
        )?))),
    }
}

fn scene_file(cx: &Cx, name: &str, bytes: &[u8], folder: Option<&Path>) -> Result<SceneFile> {
    let file = read_file(bytes, folder, cx.permissions()).and_then(SceneFile::new);
    file.map_err(|error| ApiError::Other(format!("{name}: {error}")))
}

/// Search folders for files of a scene.
fn folder_of(name: &str) -> Option<&Path> {
    Path::new(name).parent()
}

/// The path as scripts read it as the scene's.
fn absolute(cx: &Cx, filename: &str) -> String {
    let path = cx.permissions().absolute(Path::new(filename));
    path.map_or_else(
        |_| filename.to_owned(),
        |path| path.to_string_lossy().into_owned(),
    )
}

/// Closes the scene and opens the default scene. For add-ons and the sandbox, while the simulation is stopped.
///
/// @return result 1
#[api("sim.closeScene")]
fn close_scene(cx: &mut Cx) -> Result<i64> {
    cx.switch_scene(SceneSource::Default, None)?;
    Ok(1)
}
