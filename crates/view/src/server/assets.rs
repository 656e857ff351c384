//! The files of the page, joined and compressed with gzip when Swanilda is built (`build/page.rs`).

use std::io::Read;

use flate2::read::GzDecoder;

/// A file of the page.
pub(super) struct Asset {
    /// Below the address of the page, such as `main.js`.
    pub name: &'static str,
    pub gzip: &'static [u8],
    /// Another one for another content.
    pub tag: &'static str,
}

/// All of them, by name.
static ASSETS: &[Asset] = include!(concat!(env!("OUT_DIR"), "/page_files.rs"));

/// The file with that name.
pub(super) fn find(name: &str) -> Option<&'static Asset> {
    ASSETS
        .binary_search_by_key(&name, |asset| asset.name)
        .ok()
        .map(|at| &ASSETS[at])
}

/// The text of a file.
pub fn page_file(name: &str) -> Option<String> {
    let mut text = String::new();
    GzDecoder::new(find(name)?.gzip)
        .read_to_string(&mut text)
        .ok()?;
    Some(text)
}

/// The content type of a file, by its extension.
pub(super) fn content_type(name: &str) -> &'static str {
    match name.rsplit('.').next() {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("json") => "application/json; charset=utf-8",
        Some("svg") => "image/svg+xml; charset=utf-8",
        Some("txt") => "text/plain; charset=utf-8",
        Some("png") => "image/png",
        _ => "application/octet-stream",
    }
}

/// Used by the build script, tested here.
#[cfg(test)]
#[path = "../../build/bundle.rs"]
mod bundle;
#[cfg(test)]
#[allow(dead_code, reason = "most of it runs when Swanilda is built")]
#[path = "../../build/editor.rs"]
mod editor;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_by_name() {
        assert!(ASSETS.is_sorted_by_key(|asset| asset.name));
        let page = find("index.html").expect("there is a page");
        assert_eq!(page.gzip[..2], [0x1f, 0x8b]);
        // Also of builds without the component: the page asks for it.
        assert!(page_file("editor/editor.js").is_some_and(|text| text.contains("makeEditor")));
        assert!(find("../index.html").is_none() && find("").is_none());
        assert!(
            ASSETS
                .iter()
                .all(|asset| content_type(asset.name) != "application/octet-stream")
        );
    }
}
