//! Scripts: text, language and owner (spec: scene-files 7.3).

use std::collections::BTreeMap;

use super::common::{alias, user_params};
use super::{Context, HandleMap};
use crate::scene_file::migrate::{self, Origin, Thread};
use crate::scene_file::{LoadedScript, ScriptCode};
use crate::ttt::chunks::{Script as Chunk, ScriptObject as ObjectChunk};
use crate::ttt::tree::{Class, Object as FileObject};
use crate::ttt::{ScriptText, Text};
use scene::object::script_object::{ExecutionPriority, ScriptObject, ScriptType};
use scene::{Field, Scene, SceneResult};

const THREADED: u8 = 0x1;
const DISABLED: u8 = 0x2;
/// Where this bit is clear, the main script is the default one, whatever text is stored.
const OWN_MAIN_SCRIPT: u8 = 0x8;
/// A thread that ends with its text, and does not begin anew.
const ONCE: u8 = 0x10;
/// Before 3.1.3 a script ran in the sensing phase where it says so, else with the actuation.
const IN_SENSING: u8 = 0x20;
/// Both are set where a script is made for the way scripts are called since 3.1.3.
const CALLS: u8 = 0xc0;
/// The program that brought these calls; later ones do not always set the bits.
const CALLS_SINCE: u16 = 30103;
const PARENT_IS_PROXY: u8 = 0x4;
/// Since then an object says itself whether its scripts come first; where older files count from -1, it counts from 0.
const OBJECT_PRIORITY: u16 = 40400;

/// A script in the tree.
pub(super) fn object(chunk: &ObjectChunk, context: &Context<'_>) -> ScriptObject {
    let none = Chunk::default();
    let script = chunk.script.as_ref().unwrap_or(&none);
    let script_type = type_of(script).unwrap_or(ScriptType::Passive);
    let (code, language) = text(script, context);
    let disabled = script.switches.unwrap_or(0) & DISABLED != 0;
    let mut object = ScriptObject::new(script_type, code, &language, disabled);
    object.size = chunk.size.unwrap_or(object.size);
    object.reset_after_sim_error = chunk.switches.unwrap_or(0) & 1 != 0;
    object.parent_is_proxy = script.switches_2.unwrap_or(0) & PARENT_IS_PROXY != 0;
    object
}

/// A script outside of the tree. None for the default main script, and for callback scripts, which later programs do not run either.
pub(super) fn attached(
    chunk: &Chunk,
    context: &Context<'_>,
    map: &HandleMap,
) -> Option<LoadedScript> {
    let script_type = type_of(chunk)?;
    let switches = chunk.switches.unwrap_or(0);
    let owner = match script_type {
        ScriptType::Main if is_default_main(chunk, context) => return None,
        ScriptType::Main => None,
        _ => Some(*map.get(&owner(chunk))?),
    };
    let (code, language) = text(chunk, context);
    Some(LoadedScript {
        script_type,
        owner,
        code,
        source: None,
        language,
        disabled: switches & DISABLED != 0,
        exec_order: chunk.exec_order.unwrap_or(0).into(),
    })
}

/// All scripts of a file that run, in its order.
pub(super) fn texts(context: &Context<'_>) -> Vec<ScriptCode> {
    let contents = &context.file.contents;
    let known = contents
        .objects
        .iter()
        .filter_map(|object| Some((object.common.handles?[0], object)));
    let objects: ByHandle<'_> = known.collect();
    let attached = contents.scripts.iter().filter_map(|chunk| {
        let name = match type_of(chunk)? {
            ScriptType::Main if is_default_main(chunk, context) => return None,
            ScriptType::Main => "mainScript".to_owned(),
            ScriptType::Customization => path(&objects, owner(chunk)) + "@customizationScript",
            _ => path(&objects, owner(chunk)) + "@simulationScript",
        };
        Some((name, chunk))
    });
    let in_tree = contents
        .objects
        .iter()
        .filter_map(|object| match &object.class {
            Class::ScriptObject(script) => Some((
                path(&objects, object.common.handles?[0]),
                script.script.as_ref()?,
            )),
            _ => None,
        });
    let code = |(name, chunk)| {
        let (code, language) = text(chunk, context);
        ScriptCode {
            name,
            code,
            language,
        }
    };
    attached.chain(in_tree).map(code).collect()
}

/// The objects of a file by their handles.
type ByHandle<'a> = BTreeMap<i32, &'a FileObject>;

/// Deeper objects than that are named by the lower part of their path: no scene is so deep, unless a mistake of the file leads in a circle.
const MAX_DEPTH: usize = 100;

/// The path of an object of the file.
fn path(objects: &ByHandle<'_>, handle: i32) -> String {
    let parent = |object: &&FileObject| {
        let [_, parent] = object.common.handles?;
        objects.get(&parent).copied()
    };
    let chain = std::iter::successors(objects.get(&handle).copied(), parent).take(MAX_DEPTH);
    let names: Vec<String> = chain.map(|object| alias(&object.common)).collect();
    names
        .iter()
        .rev()
        .fold(String::new(), |path, name| path + "/" + name)
}

/// Whether what counts is not the text, but the main script that comes with the program.
fn is_default_main(chunk: &Chunk, context: &Context<'_>) -> bool {
    chunk.switches.unwrap_or(0) & OWN_MAIN_SCRIPT == 0 || is_before_calls(chunk, context)
}

/// Objects get what their scripts held before: parameters, and in files before 4.4 the order of execution.
///
/// # Errors
/// Never: the objects are in the scene.
pub(super) fn hand_over(
    scene: &mut Scene,
    chunk: &Chunk,
    context: &Context<'_>,
    map: &HandleMap,
) -> SceneResult<()> {
    let Some(&owner) = map.get(&owner(chunk)) else {
        return Ok(());
    };
    let params = user_params(chunk.params.as_ref());
    scene.modify(owner, Field::Other, |object| {
        if object.user_params.is_empty() {
            object.user_params = params;
        }
        if context.header.version < OBJECT_PRIORITY {
            object.priority = ExecutionPriority::from_order(chunk.exec_order.unwrap_or(0).into());
        }
    })
}

fn type_of(chunk: &Chunk) -> Option<ScriptType> {
    ScriptType::from_number(chunk.ids?[2].into())
}

/// Customization scripts of 3.2 to 3.6 name their object in a chunk of its own.
fn owner(chunk: &Chunk) -> i32 {
    let [_, owner, _] = chunk.ids.unwrap_or([-1; 3]);
    if owner >= 0 {
        owner
    } else {
        chunk.cust_obj_handle.or(chunk.coi).unwrap_or(-1)
    }
}

/// The text, ready to run, and its language.
fn text(chunk: &Chunk, context: &Context<'_>) -> (Vec<u8>, String) {
    let text = chunk
        .text
        .as_ref()
        .map(|ScriptText(text)| text.as_slice())
        .unwrap_or_default();
    let (text, marked) = without_language_mark(text);
    let language = chunk
        .lang
        .as_ref()
        .map(Text::decode)
        .filter(|l| !l.is_empty());
    let language = language.unwrap_or_else(|| marked.unwrap_or("lua").to_owned());
    if language != "lua" {
        return (text, language);
    }
    (migrate::lua(text, &origin(chunk, context)), language)
}

fn origin(chunk: &Chunk, context: &Context<'_>) -> Origin {
    let switches = chunk.switches.unwrap_or(0);
    let thread = if switches & ONCE == 0 {
        Thread::Again
    } else {
        Thread::Once
    };
    let before_calls = is_before_calls(chunk, context);
    Origin {
        thread: (switches & THREADED != 0).then_some(thread),
        before_calls,
        in_sensing: switches & IN_SENSING != 0,
        old_colours: chunk.switches_2.is_none() && context.header.version < 40000,
        ..Origin::of(context.header)
    }
}

fn is_before_calls(chunk: &Chunk, context: &Context<'_>) -> bool {
    context.header.version <= CALLS_SINCE && chunk.switches.unwrap_or(0) & CALLS != CALLS
}

/// The text without the comment that tells its language, such as `#python` or `--lua`, among the comments at its head.
fn without_language_mark(text: &[u8]) -> (Vec<u8>, Option<&'static str>) {
    let mut at = 0;
    while at < text.len() {
        let end = text[at..]
            .iter()
            .position(|byte| *byte == b'\n')
            .map_or(text.len(), |length| at + length + 1);
        let line = text[at..end].trim_ascii();
        let comment = line.strip_prefix(b"--").or_else(|| line.strip_prefix(b"#"));
        match comment.map(first_word) {
            Some(word) if word == b"python" || word == b"lua" => {
                let rest = skip_blank_lines(&text[end..]);
                let language = if word == b"lua" { "lua" } else { "python" };
                return ([&text[..at], rest].concat(), Some(language));
            }
            None if !line.is_empty() => break,
            _ => at = end,
        }
    }
    (text.to_vec(), None)
}

fn first_word(comment: &[u8]) -> &[u8] {
    let comment = comment.trim_ascii_start();
    let end = comment
        .iter()
        .position(|byte| !byte.is_ascii_alphanumeric())
        .unwrap_or(comment.len());
    &comment[..end]
}

fn skip_blank_lines(mut text: &[u8]) -> &[u8] {
    while let Some(end) = text
        .iter()
        .position(|byte| *byte == b'\n')
        .filter(|end| text[..*end].trim_ascii().is_empty())
    {
        text = &text[end + 1..];
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mark_of_the_language_is_taken_out() {
        let lua = |text: &str| (text.as_bytes().to_vec(), Some("lua"));
        assert_eq!(
            without_language_mark(b"--lua\n\nsim = require 'sim'"),
            lua("sim = require 'sim'")
        );
        assert_eq!(
            without_language_mark(b"-- a robot\n--lua\nx = 1"),
            lua("-- a robot\nx = 1")
        );
        assert_eq!(without_language_mark(b"#python\nx = 1").1, Some("python"));
        for unmarked in ["", "x = 1 --lua", "-- luanda\nx", "--[[lua]]", "\n\n"] {
            assert_eq!(
                without_language_mark(unmarked.as_bytes()),
                (unmarked.as_bytes().to_vec(), None),
                "{unmarked}"
            );
        }
    }
}
