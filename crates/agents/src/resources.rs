//! What clients can read: the scene, its scripts, pages of the reference.

use mcp::{Contents, NotFound, Resource, Template};
use serde_json::Value;

use crate::agent::Agent;
use crate::tools::scene::{rows, tree_lines};
use crate::tools::{all_scripts, script_source};

const SCENE: &str = "scene://tree";
const SCRIPT: &str = "script://";
const DOCS: &str = "docs://";

const PLAIN: &str = "text/plain";
const LUA: &str = "text/x-lua";
const MARKDOWN: &str = "text/markdown";

/// What there is now.
pub(crate) fn all(agent: &mut Agent) -> Vec<Resource> {
    let scene = Resource {
        uri: SCENE.into(),
        name: "scene".into(),
        description: "The scene as a tree".into(),
        mime_type: PLAIN,
    };
    let script = |(path, _): (String, String)| Resource {
        uri: format!("{SCRIPT}{path}"),
        description: format!("The script {path}"),
        name: path,
        mime_type: LUA,
    };
    let page = |(path, _): (String, String)| Resource {
        uri: format!("{DOCS}{path}"),
        description: "A page of the reference".into(),
        name: path,
        mime_type: MARKDOWN,
    };
    let scripts = all_scripts(agent).unwrap_or_default();
    std::iter::once(scene)
        .chain(scripts.into_iter().map(script))
        .chain(pages().map(page))
        .collect()
}

/// Pages that are in the program: those that are generated from its functions.
fn pages() -> impl Iterator<Item = (String, String)> {
    docs::files().into_iter().filter_map(|(path, text)| {
        let path = path.strip_prefix("docs/")?.to_owned();
        path.ends_with(".md").then_some((path, text))
    })
}

pub(crate) fn templates() -> Vec<Template> {
    vec![
        Template {
            uri: "script://{+path}",
            name: "script",
            description: "The text of a script of the scene, by its path",
            mime_type: LUA,
        },
        Template {
            uri: "docs://{+page}",
            name: "reference",
            description: "A page of the reference",
            mime_type: MARKDOWN,
        },
    ]
}

/// # Errors
/// When there is no such resource.
pub(crate) fn read(agent: &mut Agent, uri: &str) -> Result<Contents, NotFound> {
    let contents = |mime_type, text| Contents { mime_type, text };
    if uri == SCENE {
        let rows = rows(agent, None).map_err(NotFound)?;
        return Ok(contents(PLAIN, tree_lines(&rows, usize::MAX).concat()));
    }
    if let Some(path) = uri.strip_prefix(SCRIPT) {
        let source = script_source(agent, &Value::from(path));
        return source
            .map(|(_, code)| contents(LUA, code))
            .map_err(NotFound);
    }
    if let Some(page) = uri.strip_prefix(DOCS) {
        let found = pages().find(|(path, _)| path == page);
        return found
            .map(|(_, text)| contents(MARKDOWN, text))
            .ok_or_else(|| NotFound(format!("there is no page {page}; resources/list has all")));
    }
    Err(NotFound(format!(
        "there is no resource {uri}; resources/list has all"
    )))
}
