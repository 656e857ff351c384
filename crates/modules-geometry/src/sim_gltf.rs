//! `simGLTF`: a glTF file in memory, to which objects and their movements are added, and which is written, read, and added to the scene.

use std::cell::{Cell, RefCell};
use std::path::Path;

use api_macro::api;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use format::gltf_file::{GltfFile, Recording};
use format::scene_file::write_whole;
use scene::{Handle, SceneError};
use script::log::verbosity;
use script::{Handles, Hooks, Host};

/// The module `simGLTF`.
pub static MODULE: Module = Module {
    about: "glTF files: scenes with colours, textures, cameras, lights and recorded movements.",
    functions: &[
        ("Contents", CONTENTS),
        ("Files", FILES),
        ("Animation", ANIMATION),
    ],
    constants: "TextureFormat.bmp\t6761\nTextureFormat.png\t6762\nTextureFormat.jpg\t6763\n",
    hooks: Hooks {
        after_step: Some(record_step),
        ..Hooks::NONE
    },
    ..Module::new("simGLTF")
};

const CONTENTS: &[ApiFn] = functions![
    clear,
    export_shape,
    export_object,
    export_objects,
    export_all_objects,
    export_selected_objects,
    import_objects,
    get_export_texture_format,
    set_export_texture_format,
];
const FILES: &[ApiFn] = functions![load_ascii, load_binary, save_ascii, save_binary, serialize];
const ANIMATION: &[ApiFn] = functions![record_animation, animation_frame_count, export_animation];

/// Numbers and names of the formats of textures.
const TEXTURE_FORMATS: [(i64, &str); 3] = [(6761, "bmp"), (6762, "png"), (6763, "jpg")];

/// What the module keeps for a simulator.
struct State {
    file: RefCell<GltfFile>,
    recording: RefCell<Recording>,
    texture_format: Cell<(i64, &'static str)>,
}

impl Default for State {
    fn default() -> Self {
        let texture_format = Cell::new(TEXTURE_FORMATS[1]);
        Self {
            file: RefCell::default(),
            recording: RefCell::default(),
            texture_format,
        }
    }
}

/// Empties the file in memory.
#[api("simGLTF.clear")]
fn clear(cx: &mut Cx) -> Result<()> {
    cx.module_state::<State>().file.take();
    Ok(())
}

/// Adds a shape to the file in memory, also one that is not visible.
///
/// @param shapeHandle the shape
/// @param parentHandle the object in whose frame the shape is placed; -1: the world
/// @param parentNodeIndex the node below which it is; 0: the scene
/// @return nodeIndex
#[api("simGLTF.exportShape")]
fn export_shape(
    cx: &mut Cx,
    shape_handle: Handle,
    #[default(-1)] parent_handle: i64,
    #[default(0)] parent_node_index: i64,
) -> Result<i64> {
    let parent = match parent_handle {
        -1 => None,
        raw => Some(Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?),
    };
    let state = cx.module_state::<State>();
    let mut file = state.file.borrow_mut();
    let node = usize::try_from(parent_node_index)
        .ok()
        .filter(|node| *node < file.asset().nodes.len());
    let node =
        node.ok_or_else(|| ApiError::Other(format!("there is no node {parent_node_index}.")))?;
    let exported = file.add_shape(
        &cx.scene(),
        shape_handle,
        (parent, node),
        state.texture_format.get().1,
    )?;
    Ok(exported as i64)
}

/// Adds an object to the file in memory, below the node of its parent, if that was added before.
///
/// Shapes that are not visible, and objects without a mesh, a camera or a light, become nodes without contents.
///
/// @param objectHandle the object
/// @return nodeIndex
#[api("simGLTF.exportObject")]
fn export_object(cx: &mut Cx, object_handle: Handle) -> Result<i64> {
    let state = cx.module_state::<State>();
    let mut file = state.file.borrow_mut();
    Ok(file.add_object(&cx.scene(), object_handle, state.texture_format.get().1)? as i64)
}

/// Adds objects to the file in memory, with their tree; scripts are left out.
///
/// @param objectHandles the objects
#[api("simGLTF.exportObjects")]
fn export_objects(cx: &mut Cx, object_handles: Handles) -> Result<()> {
    let handles: Option<Vec<Handle>> = object_handles.0.into_iter().map(Handle::from_raw).collect();
    add(cx, &handles.ok_or(SceneError::NoSuchObject)?)
}

/// Adds all objects of the scene to the file in memory, with their tree; scripts are left out.
#[api("simGLTF.exportAllObjects")]
fn export_all_objects(cx: &mut Cx) -> Result<()> {
    let all: Vec<Handle> = cx.scene().objects().map(scene::Object::handle).collect();
    add(cx, &all)
}

/// Adds the selected objects to the file in memory, with their tree; scripts are left out.
#[api("simGLTF.exportSelectedObjects")]
fn export_selected_objects(cx: &mut Cx) -> Result<()> {
    let selected = cx.scene().selection().to_vec();
    add(cx, &selected)
}

fn add(cx: &mut Cx, handles: &[Handle]) -> Result<()> {
    let state = cx.module_state::<State>();
    state
        .file
        .borrow_mut()
        .add_objects(&cx.scene(), handles, state.texture_format.get().1)?;
    Ok(())
}

/// Adds the nodes of the file in memory to the scene: shapes, cameras, lights, and dummies for nodes that only have a name. Not in CoppeliaSim.
///
/// @return objectHandles parents before their children
#[api("simGLTF.importObjects")]
fn import_objects(cx: &mut Cx) -> Result<Vec<Handle>> {
    let state = cx.module_state::<State>();
    let (handles, warnings) = state.file.borrow().add_to(&mut cx.scene_mut())?;
    for warning in warnings {
        cx.env().log(verbosity::SCRIPT_WARNINGS, &warning);
    }
    cx.notify_created(&handles);
    Ok(handles)
}

/// The format of textures in exports.
///
/// @return textureFormat simGLTF.TextureFormat
/// @return formatName bmp, png or jpg
#[api("simGLTF.getExportTextureFormat")]
fn get_export_texture_format(cx: &Cx) -> Result<(i64, String)> {
    let (number, name) = cx.module_state::<State>().texture_format.get();
    Ok((number, name.into()))
}

/// Sets the format of textures in exports. glTF knows PNG and JPEG; few programs read BMP in it.
///
/// @param textureFormat simGLTF.TextureFormat
#[api("simGLTF.setExportTextureFormat")]
fn set_export_texture_format(cx: &mut Cx, texture_format: i64) -> Result<()> {
    let known = TEXTURE_FORMATS
        .into_iter()
        .find(|(number, _)| *number == texture_format);
    let format = known.ok_or_else(|| ApiError::Other("invalid texture format.".into()))?;
    cx.module_state::<State>().texture_format.set(format);
    Ok(())
}

/// Reads a file of text (`.gltf`) in place of the one in memory. importObjects adds it to the scene.
///
/// @param filepath the file
/// @return result whether it was read
/// @return warnings what was left out, a line each
/// @return errors what is wrong with it
#[api("simGLTF.loadASCII")]
fn load_ascii(cx: &mut Cx, filepath: String) -> Result<(bool, String, String)> {
    load(cx, &filepath, |bytes| !bytes.starts_with(b"glTF"))
}

/// Reads a binary file (`.glb`) in place of the one in memory. importObjects adds it to the scene.
///
/// @param filepath the file
/// @return result whether it was read
/// @return warnings what was left out, a line each
/// @return errors what is wrong with it
#[api("simGLTF.loadBinary")]
fn load_binary(cx: &mut Cx, filepath: String) -> Result<(bool, String, String)> {
    load(cx, &filepath, |bytes| bytes.starts_with(b"glTF"))
}

fn load(cx: &mut Cx, name: &str, is_of_kind: fn(&[u8]) -> bool) -> Result<(bool, String, String)> {
    let permissions = cx.permissions();
    let bytes = match permissions.read_file(Path::new(name)) {
        Ok(bytes) => bytes,
        Err(error) => return Ok((false, String::new(), format!("{name}: {error}"))),
    };
    if !is_of_kind(&bytes) {
        return Ok((
            false,
            String::new(),
            format!("{name}: loadBinary reads binary files, loadASCII files of text"),
        ));
    }
    match GltfFile::parse(&bytes, Path::new(name), permissions) {
        Ok(file) => {
            let warnings = file.asset().warnings.join("\n");
            cx.module_state::<State>().file.replace(file);
            Ok((true, warnings, String::new()))
        }
        Err(error) => Ok((false, String::new(), format!("{name}: {error}"))),
    }
}

/// Writes the file in memory as text (`.gltf`), with buffers and textures inside.
///
/// @param filepath the file
/// @return result whether it was written; why not is logged
#[api("simGLTF.saveASCII")]
fn save_ascii(cx: &mut Cx, filepath: String) -> Result<bool> {
    let text = text(cx)?;
    Ok(save(cx, &filepath, text.as_bytes()))
}

/// Writes the file in memory as a binary one (`.glb`).
///
/// @param filepath the file
/// @return result whether it was written; why not is logged
#[api("simGLTF.saveBinary")]
fn save_binary(cx: &mut Cx, filepath: String) -> Result<bool> {
    let bytes = cx.module_state::<State>().file.borrow().asset().to_binary();
    Ok(save(cx, &filepath, &bytes.map_err(not_writable)?))
}

fn save(cx: &mut Cx, name: &str, bytes: &[u8]) -> bool {
    let path = Path::new(name);
    let permissions = cx.permissions();
    let written = permissions
        .check_write(path)
        .map_err(Into::into)
        .and_then(|()| permissions.write(path, || write_whole(path, bytes)));
    if let Err(error) = &written {
        cx.env().log(
            verbosity::SCRIPT_ERRORS,
            &format!("cannot write {name}: {error}"),
        );
    }
    written.is_ok()
}

/// The file in memory as text.
///
/// @return json
#[api("simGLTF.serialize")]
fn serialize(cx: &Cx) -> Result<String> {
    text(cx)
}

fn text(cx: &Cx) -> Result<String> {
    cx.module_state::<State>()
        .file
        .borrow()
        .asset()
        .to_text()
        .map_err(not_writable)
}

fn not_writable(error: mesh_files::WriteError) -> ApiError {
    ApiError::Other(format!("{error}."))
}

/// Records how objects move, from the next simulation step on, in place of what was recorded before; or ends that.
///
/// @param enable whether to record
#[api("simGLTF.recordAnimation")]
fn record_animation(cx: &mut Cx, enable: bool) -> Result<()> {
    let state = cx.module_state::<State>();
    let mut recording = state.recording.borrow_mut();
    if enable {
        recording.start();
    } else {
        recording.stop();
    }
    Ok(())
}

/// Adds what was recorded to the file in memory, as an animation of the objects that were exported.
#[api("simGLTF.exportAnimation")]
fn export_animation(cx: &mut Cx) -> Result<()> {
    let state = cx.module_state::<State>();
    state
        .file
        .borrow_mut()
        .add_animation(&state.recording.borrow());
    Ok(())
}

/// How many steps were recorded.
///
/// @return count
#[api("simGLTF.animationFrameCount")]
fn animation_frame_count(cx: &Cx) -> Result<i64> {
    Ok(cx.module_state::<State>().recording.borrow().frames() as i64)
}

fn record_step(host: &Host<'_>) {
    let Some(state) = host.module_state::<State>() else {
        return;
    };
    let mut recording = state.recording.borrow_mut();
    if !recording.is_on() {
        return;
    }
    let (scene, time) = (host.scene(), host.clock().time());
    if !recording.record(&scene, time, scene.settings().time_step) {
        host.log(
            verbosity::SCRIPT_WARNINGS,
            "simGLTF: the recording ends, it has become too large.",
        );
    }
}
