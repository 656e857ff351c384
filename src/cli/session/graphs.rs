//! The option about graphs.

use std::path::PathBuf;

use format::graph_file::{GraphData, GraphFile};
use format::scene_file::write_whole;
use scene::{Handle, Scene};
use simulator::Simulator;

/// The graphs of a run, as files.
#[derive(clap::Args)]
pub(in crate::cli) struct GraphArgs {
    /// Write what a graph has recorded to a file, such as /Graph=speeds.svg (svg or csv); may be repeated
    #[arg(long, value_name = "PATH=FILE", value_parser = graph_file)]
    graph: Vec<(String, PathBuf)>,
}

impl GraphArgs {
    /// Writes the files; the first reason why one could not be written.
    pub(in crate::cli) fn write(&self, sim: &Simulator) -> Result<(), String> {
        self.graph.iter().try_for_each(|(path, file)| {
            let scene = sim.scene();
            let data = find(&scene, path).ok_or_else(|| format!("there is no graph {path}"))?;
            write(&data, file)
        })
    }
}

/// A graph's path and the file: what is before and after the last equals sign.
fn graph_file(text: &str) -> Result<(String, PathBuf), String> {
    let parts = text
        .rsplit_once('=')
        .filter(|(path, file)| !path.is_empty() && !file.is_empty());
    let (path, file) = parts.ok_or("PATH=FILE is needed, such as /Graph=speeds.svg")?;
    kind_of(&PathBuf::from(file)).map(|_| (path.to_owned(), file.into()))
}

pub(in crate::cli) fn kind_of(file: &std::path::Path) -> Result<GraphFile, String> {
    let extension = file.extension().unwrap_or_default().to_string_lossy();
    GraphFile::of_extension(&extension).ok_or_else(|| match extension.as_ref() {
        "svg" => "this build draws no graphs: build Swanilda with the feature `plots`".into(),
        _ => format!("graphs become .svg or .csv files, not .{extension}"),
    })
}

pub(in crate::cli) fn write(data: &GraphData, file: &std::path::Path) -> Result<(), String> {
    let content = data.file(kind_of(file)?);
    write_whole(file, &content).map_err(|error| format!("cannot write {}: {error}", file.display()))
}

fn find(scene: &Scene, path: &str) -> Option<GraphData> {
    let by_handle = path
        .parse()
        .ok()
        .and_then(Handle::from_raw)
        .filter(|handle| scene.exists(*handle));
    let full = if path.starts_with('/') {
        path.to_owned()
    } else {
        format!("/{path}")
    };
    let handle = by_handle.or_else(|| scene.find(&full, None, None).ok())?;
    let graph = scene.object(handle).ok()?.graph().ok()?;
    Some(GraphData::new(
        graph,
        &scene.short_path(handle).unwrap_or(full),
    ))
}
