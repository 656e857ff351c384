//! Scripts: script objects, attached scripts, the main script.

use crate::scene_file::LoadedScript;
use crate::ttt::chunks::{Colour, Script as Chunk, ScriptObject as ObjectChunk};
use crate::ttt::{Counted, ScriptText};
use scene::Handle;
use scene::object::script_object::{ScriptObject, ScriptType};

const DISABLED: u8 = 0x2;
const OWN_MAIN_SCRIPT: u8 = 0x8;
/// Scripts since 3.1.3 and 3.1.4 are marked so.
const PRESENT_ENGINE: u8 = 0xc0;
const SINCE_3_1_4: u8 = 0x1;
const PARENT_IS_PROXY: u8 = 0x4;
const DEFAULT_MAIN_SCRIPT: &[u8] = b"require('defaultMainScript')";

/// A script in the tree.
pub(super) fn object(script: &ScriptObject, handle: Handle, colour: Option<Colour>) -> ObjectChunk {
    let mut chunk = chunk(
        script.script_type,
        handle.0.cast_signed(),
        &script.code,
        &script.language,
    );
    chunk.switches = Some(switches(script.disabled));
    chunk.switches_2 = Some(
        SINCE_3_1_4
            | if script.parent_is_proxy {
                PARENT_IS_PROXY
            } else {
                0
            },
    );
    ObjectChunk {
        size: Some(script.size),
        switches: Some(script.reset_after_sim_error.into()),
        colour,
        script: Some(chunk),
    }
}

/// A script attached to an object.
pub(super) fn attached(script: &LoadedScript) -> Chunk {
    let owner = script.owner.map_or(-1, |owner| owner.0.cast_signed());
    let mut chunk = chunk(script.script_type, owner, &script.code, &script.language);
    chunk.switches = Some(switches(script.disabled));
    chunk.exec_order = Some(numbers::low_i32(script.exec_order));
    chunk
}

/// A main script of the scene's own.
pub(super) fn main(script: &LoadedScript) -> Chunk {
    attached(script)
}

/// The main script every scene has unless it says otherwise.
pub(super) fn default_main() -> Chunk {
    let mut chunk = chunk(ScriptType::Main, -1, DEFAULT_MAIN_SCRIPT, "lua");
    chunk.switches = Some(PRESENT_ENGINE);
    chunk
}

fn switches(disabled: bool) -> u8 {
    PRESENT_ENGINE | OWN_MAIN_SCRIPT | if disabled { DISABLED } else { 0 }
}

fn chunk(script_type: ScriptType, owner: i32, code: &[u8], language: &str) -> Chunk {
    Chunk {
        ids: Some([0, owner, script_type as i32]),
        switches_2: Some(SINCE_3_1_4),
        exec_order: Some(1),
        text: Some(ScriptText(marked(code, language))),
        modules: Some(Counted(Vec::new())),
        cust_obj_handle: Some(owner),
        lang: Some(language.into()),
        ..Chunk::default()
    }
}

/// The text behind a comment that tells older programs its language. Readers take it out with the blank lines that follow; a text that
/// begins with such lines would lose them, and goes without.
fn marked(code: &[u8], language: &str) -> Vec<u8> {
    let first_line = code.split(|byte| *byte == b'\n').next().unwrap_or_default();
    if first_line.trim_ascii().is_empty() && !code.is_empty() {
        return code.to_vec();
    }
    let mark: &[u8] = if language == "python" {
        b"#python\n"
    } else {
        b"--lua\n"
    };
    [mark, code].concat()
}
