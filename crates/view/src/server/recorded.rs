//! A recording as a site: the page, the index, chunks and blobs, from a file that is read when somebody asks.

use std::io::{Read, Seek};
use std::sync::{Arc, Mutex, PoisonError};

use serde_json::{Value, json};

use super::assets;
use super::site::{asset_reply, common_headers, inside, not_found};
use crate::blobs::Hash;
use crate::recording::{Recording, RecordingError, gzip};
use io::{Site, SiteReply, Visitor};

/// The viewer of a recording.
pub(crate) struct RecordedSite<R> {
    recording: Mutex<Recording<R>>,
    /// Above all addresses: 128 random bits.
    token: String,
}

impl<R: Read + Seek + Send + 'static> RecordedSite<R> {
    pub(crate) fn new(recording: Recording<R>, token: String) -> Self {
        Self {
            recording: Mutex::new(recording),
            token,
        }
    }

    /// Index, chunk or blob; None where there is none.
    fn part(&self, name: &str) -> Result<Option<SiteReply>, RecordingError> {
        let mut recording = self
            .recording
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        if name == "recording" {
            let index = recording
                .index()
                .json(|hash, _| Value::from(format!("blob/{hash}")));
            return Ok(Some(reply(
                "application/json; charset=utf-8",
                index.to_string().into_bytes(),
            )));
        }
        if let Some(number) = name.strip_prefix("recording/") {
            let there = |number: &usize| *number < recording.index().chunks.len();
            let Some(number) = number.parse().ok().filter(there) else {
                return Ok(None);
            };
            return Ok(Some(reply(
                "application/gzip",
                gzip(&recording.chunk(number)?)?,
            )));
        }
        let Some(hash) = name.strip_prefix("blob/").and_then(Hash::from_text) else {
            return Ok(None);
        };
        Ok(recording
            .blob(hash)?
            .map(|bytes| reply("application/octet-stream", bytes)))
    }
}

/// A recording that is being written may be another one at the next start, at the same address.
fn reply(content_type: &str, body: Vec<u8>) -> SiteReply {
    let mut headers = common_headers();
    headers.push(("Content-Type", content_type.to_owned()));
    headers.push(("Cache-Control", "no-cache".to_owned()));
    SiteReply {
        status: 200,
        headers,
        body: Arc::new(body),
    }
}

impl<R: Read + Seek + Send + 'static> Site for RecordedSite<R> {
    fn get(&self, path: &str, known: Option<&str>) -> SiteReply {
        let Some(name) = inside(&self.token, path) else {
            return not_found();
        };
        let name = if name.is_empty() { "index.html" } else { name };
        if let Some(asset) = assets::find(name) {
            return asset_reply(asset, known);
        }
        match self.part(name) {
            Ok(part) => part.unwrap_or_else(not_found),
            Err(error) => {
                let body = json!({ "error": error.to_string() })
                    .to_string()
                    .into_bytes();
                SiteReply {
                    status: 500,
                    ..reply("application/json; charset=utf-8", body)
                }
            }
        }
    }

    /// Nothing happens in a recording that a page would have to be told.
    fn open(&self, _: &str) -> Option<Box<dyn Visitor>> {
        None
    }
}
