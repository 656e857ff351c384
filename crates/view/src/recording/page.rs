//! A recording and the page that plays it as one HTML file, which needs no server (docs/VIEW_PROTOCOL.md, "One file").

use std::io::{Read, Seek, Write};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;

use super::{Recording, RecordingError};

/// What the page has outside of itself.
const STYLE: &str = "<link rel=\"stylesheet\" href=\"style.css\">";
const SCRIPT: &str = "<script type=\"module\" src=\"main.js\"></script>";

/// Writes the file; `read` finds the files of the page by name.
///
/// # Errors
/// When the recording is damaged, or the file cannot be written.
pub fn html<R: Read + Seek>(
    recording: &mut Recording<R>,
    read: &dyn Fn(&str) -> Option<String>,
    out: &mut impl Write,
) -> Result<(), RecordingError> {
    let wrong_page =
        || std::io::Error::other("the page of the viewer is not as its recordings need it");
    let page = read("index.html").ok_or_else(wrong_page)?;
    let (head, rest) = page.split_once(STYLE).ok_or_else(wrong_page)?;
    let (body, end) = rest.split_once(SCRIPT).ok_or_else(wrong_page)?;
    let style = read("style.css").ok_or_else(wrong_page)?;
    let program = read("main.js").ok_or_else(wrong_page)?;
    write!(out, "{head}<style>\n{style}</style>{body}")?;
    let index = recording
        .index()
        .json(|_, chunk| chunk.into())
        .to_string()
        .replace('<', "\\u003c");
    writeln!(
        out,
        "<script type=\"application/json\" id=\"recording\">{index}</script>"
    )?;
    for number in 0..recording.index().chunks.len() {
        let chunk = STANDARD.encode(gzip(&recording.chunk(number)?)?);
        writeln!(
            out,
            "<script type=\"application/octet-stream\" data-chunk=\"{number}\">{chunk}</script>"
        )?;
    }
    // Within a script element, `</` could end it.
    let program = program.replace("</script", "<\\/script");
    write!(out, "<script type=\"module\">\n{program}</script>{end}")?;
    Ok(out.flush()?)
}

/// The bytes compressed by gzip, without a date.
///
/// # Errors
/// None in memory.
pub fn gzip(bytes: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes)?;
    encoder.finish()
}
