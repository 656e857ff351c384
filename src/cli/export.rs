//! `swanilda export`: a recording as a page, for other programs, or a graph of it as a picture or table.

use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde_json::Value;

use super::Outcome;
use super::graphs;
use format::graph_file::GraphData;
use format::scene_file::WholeFile;
use view::mcap;
use view::recording::{self, Content, Recording, RecordingError};

/// Write a recording as one HTML file, as MCAP for Foxglove and Rerun, or a graph of it as SVG or CSV
#[derive(clap::Args)]
#[command(group(clap::ArgGroup::new("what").required(true).multiple(true)))]
pub(super) struct Args {
    /// Recording, from `swanilda run --record`
    recording: PathBuf,
    /// Write a page that plays the recording and needs no server
    #[arg(long, value_name = "FILE", group = "what")]
    html: Option<PathBuf>,
    /// Write poses, shapes, joints, images and the log with the schemas of Foxglove
    #[arg(long, value_name = "FILE", group = "what")]
    mcap: Option<PathBuf>,
    /// Write what this graph has recorded to the file of --output
    #[arg(long, value_name = "PATH", group = "what", requires = "output")]
    graph: Option<String>,
    /// File for the graph: svg or csv
    #[arg(long, short, value_name = "FILE", requires = "graph")]
    output: Option<PathBuf>,
}

pub(super) fn export(args: &Args) -> Outcome {
    args.export().map(|()| ExitCode::SUCCESS)
}

impl Args {
    fn export(&self) -> Result<(), String> {
        let mut recording = open(&self.recording)?;
        if let Some(path) = &self.html {
            whole(path, |file| {
                recording::html(&mut recording, &view::page_file, file)
            })?;
        }
        if let Some(path) = &self.mcap {
            whole(path, |file| mcap::write(&mut recording, file))?;
        }
        if let (Some(graph), Some(output)) = (&self.graph, &self.output) {
            graphs::kind_of(output)?;
            graphs::write(&find_graph(&mut recording, graph)?, output)?;
        }
        Ok(())
    }
}

/// Opens a recording.
///
/// # Errors
/// When it cannot be read.
pub(super) fn open(path: &Path) -> Result<Recording<BufReader<File>>, String> {
    let unreadable = |error: RecordingError| format!("cannot read {}: {error}", path.display());
    let file = File::open(path).map_err(|error| unreadable(error.into()))?;
    Recording::open(BufReader::new(file)).map_err(unreadable)
}

/// Writes a file whole or not at all.
fn whole<E: std::fmt::Display>(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<WholeFile>) -> Result<(), E>,
) -> Result<(), String> {
    let unwritable =
        |error: &dyn std::fmt::Display| format!("cannot write {}: {error}", path.display());
    let mut file = BufWriter::new(WholeFile::create(path).map_err(|error| unwritable(&error))?);
    write(&mut file).map_err(|error| unwritable(&error))?;
    file.flush().map_err(|error| unwritable(&error))?;
    let file = file.into_inner().map_err(|error| unwritable(&error))?;
    file.finish().map_err(|error| unwritable(&error))
}

/// The graph with that path or handle: graphs are at the end.
fn find_graph(
    recording: &mut Recording<impl Read + Seek>,
    name: &str,
) -> Result<GraphData, String> {
    let last = recording.index().chunks.len().saturating_sub(1);
    let chunk = recording
        .chunk(last)
        .map_err(|error| format!("cannot read the recording: {error}"))?;
    let mut known = Vec::new();
    for message in recording::messages(&chunk).flatten() {
        let Content::Text(text) = message.content else {
            continue;
        };
        let graphs = serde_json::from_str::<Value>(text)
            .ok()
            .and_then(|message| recording::graphs(&message));
        known.extend(graphs.unwrap_or_default());
    }
    let names: Vec<String> = known.iter().map(|(_, graph)| graph.title.clone()).collect();
    let is_it = |handle: i64, title: &str| {
        title == name || title == format!("/{name}") || handle.to_string() == name
    };
    let found = known
        .into_iter()
        .find(|(handle, graph)| is_it(*handle, &graph.title));
    found.map(|(_, graph)| graph).ok_or_else(|| match names.as_slice() {
        [] => "there are no graphs in this recording: they come with its end, or the scene has none".to_owned(),
        names => format!("there is no graph {name}: there are {}", names.join(", ")),
    })
}
