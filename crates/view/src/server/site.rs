//! Addresses: the page and its files, blobs, the stream. All of them are below a secret, so that no other program or user of this machine finds them.

use std::sync::Arc;

use ring::rand::{SecureRandom, SystemRandom};

use super::Shared;
use super::assets::{self, Asset};
use super::reference;
use super::visitor::Page;
use crate::blobs::{Blob, Hash};
use io::{Site, SiteReply, Visitor};

/// Scripts, styles, connections and images come from this server only, and no other page may frame this one.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data: blob:; \
                      font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// The viewer as a site.
pub(crate) struct ViewSite {
    shared: Arc<Shared>,
    /// Above all addresses: 128 random bits.
    token: String,
}

impl ViewSite {
    pub(crate) fn new(shared: Arc<Shared>, token: String) -> Self {
        Self { shared, token }
    }

    /// A secret for the addresses of a run.
    ///
    /// # Errors
    /// When the system has no random numbers.
    pub(crate) fn new_token() -> std::io::Result<String> {
        let mut bytes = [0; 16];
        let filled = SystemRandom::new().fill(&mut bytes);
        filled.map_err(|_| std::io::Error::other("the system has no random numbers"))?;
        Ok(format!("{:032x}", u128::from_be_bytes(bytes)))
    }
}

/// What comes after the secret in a path, without a query; None where the secret is wrong.
pub(super) fn inside<'a>(secret: &str, path: &'a str) -> Option<&'a str> {
    let path = path.split(['?', '#']).next()?;
    let (token, rest) = path.strip_prefix('/')?.split_once('/')?;
    // All bytes are compared, so that time says nothing about how many of them are right.
    let differences = token
        .bytes()
        .zip(secret.bytes())
        .fold(0, |all, (a, b)| all | (a ^ b));
    (differences == 0 && token.len() == secret.len()).then_some(rest)
}

impl Site for ViewSite {
    fn get(&self, path: &str, known: Option<&str>) -> SiteReply {
        let Some(name) = inside(&self.token, path) else {
            return not_found();
        };
        if let Some(hash) = name.strip_prefix("blob/") {
            let blob = Hash::from_text(hash).and_then(|hash| self.shared.mirror().blob(hash));
            return blob.map_or_else(not_found, blob_reply);
        }
        if name == "recording" {
            return no_recording();
        }
        if name == reference::NAME {
            return compressed_json(reference::compressed());
        }
        let name = if name.is_empty() { "index.html" } else { name };
        assets::find(name).map_or_else(not_found, |asset| asset_reply(asset, known))
    }

    fn open(&self, path: &str) -> Option<Box<dyn Visitor>> {
        (inside(&self.token, path)? == "stream")
            .then(|| Box::new(Page::new(Arc::clone(&self.shared))) as Box<dyn Visitor>)
    }
}

pub(super) fn common_headers() -> Vec<(&'static str, String)> {
    [
        ("Content-Security-Policy", POLICY),
        ("X-Content-Type-Options", "nosniff"),
        ("Referrer-Policy", "no-referrer"),
        ("Cross-Origin-Resource-Policy", "same-origin"),
        ("Cross-Origin-Opener-Policy", "same-origin"),
    ]
    .map(|(name, value)| (name, value.to_owned()))
    .to_vec()
}

pub(super) fn not_found() -> SiteReply {
    let mut headers = common_headers();
    headers.push(("Content-Type", "text/plain; charset=utf-8".to_owned()));
    SiteReply {
        status: 404,
        headers,
        body: Arc::new(b"There is nothing at this address.".to_vec()),
    }
}

/// Every page asks for a recording first: that there is none is no error.
fn no_recording() -> SiteReply {
    SiteReply {
        status: 204,
        headers: common_headers(),
        body: Arc::new(Vec::new()),
    }
}

fn blob_reply(blob: Arc<Blob>) -> SiteReply {
    let mut headers = common_headers();
    headers.push(("Content-Type", "application/octet-stream".to_owned()));
    headers.push((
        "Cache-Control",
        "private, max-age=31536000, immutable".to_owned(),
    ));
    SiteReply {
        status: 200,
        headers,
        body: blob,
    }
}

fn compressed_json(gzip: &'static [u8]) -> SiteReply {
    let mut headers = common_headers();
    headers.push(("Cache-Control", "no-cache".to_owned()));
    headers.push(("Content-Type", assets::content_type(".json").to_owned()));
    headers.push(("Content-Encoding", "gzip".to_owned()));
    SiteReply {
        status: 200,
        headers,
        body: Arc::new(gzip),
    }
}

pub(super) fn asset_reply(asset: &'static Asset, known: Option<&str>) -> SiteReply {
    let tag = format!("\"{}\"", asset.tag);
    let mut headers = common_headers();
    headers.push(("ETag", tag.clone()));
    headers.push(("Cache-Control", "no-cache".to_owned()));
    if known == Some(&*tag) {
        return SiteReply {
            status: 304,
            headers,
            body: Arc::new(Vec::new()),
        };
    }
    headers.push(("Content-Type", assets::content_type(asset.name).to_owned()));
    headers.push(("Content-Encoding", "gzip".to_owned()));
    SiteReply {
        status: 200,
        headers,
        body: Arc::new(asset.gzip),
    }
}

impl AsRef<[u8]> for Blob {
    fn as_ref(&self) -> &[u8] {
        &self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn site() -> ViewSite {
        ViewSite::new(
            Arc::default(),
            "0123456789abcdef0123456789abcdef".to_owned(),
        )
    }

    #[test]
    fn addresses_without_the_secret_lead_nowhere() {
        let site = site();
        assert_eq!(
            site.get("/0123456789abcdef0123456789abcdef/", None).status,
            200
        );
        assert_eq!(
            site.get("/0123456789abcdef0123456789abcdef/?x=1", None)
                .status,
            200
        );
        for path in [
            "",
            "/",
            "/0123456789abcdef0123456789abcdef",
            "/0123456789abcdef0123456789abcdee/",
            "/0123456789abcdef/",
            "//",
            "/index.html",
            "/0123456789abcdef0123456789abcdef/../index.html",
            "/0123456789abcdef0123456789abcdef/blob/x",
            "http://127.0.0.1/0123456789abcdef0123456789abcdef/",
        ] {
            assert_eq!(site.get(path, None).status, 404, "{path}");
            assert!(site.open(path).is_none());
        }
        assert!(
            site.open("/0123456789abcdef0123456789abcdef/stream")
                .is_some()
        );
        assert!(site.open("/stream").is_none());
    }

    #[test]
    fn a_browser_that_has_a_file_is_not_sent_it_again() {
        let site = site();
        let reply = site.get("/0123456789abcdef0123456789abcdef/", None);
        let tag = reply
            .headers
            .iter()
            .find(|(name, _)| *name == "ETag")
            .expect("files have a tag")
            .1
            .clone();
        assert_eq!(
            site.get("/0123456789abcdef0123456789abcdef/", Some(&tag))
                .status,
            304
        );
        assert!(
            reply.headers.iter().any(
                |(name, value)| *name == "Content-Security-Policy" && !value.contains("unsafe")
            )
        );
    }

    #[test]
    fn a_simulator_that_runs_has_no_recording() {
        let reply = site().get("/0123456789abcdef0123456789abcdef/recording", None);
        assert_eq!((reply.status, (*reply.body).as_ref().len()), (204, 0));
        assert_eq!(
            site()
                .get("/0123456789abcdef0123456789abcdef/recording/0", None)
                .status,
            404
        );
    }

    #[test]
    fn secrets_differ() {
        assert_ne!(
            ViewSite::new_token().unwrap(),
            ViewSite::new_token().unwrap()
        );
        assert_eq!(ViewSite::new_token().unwrap().len(), 32);
    }
}
