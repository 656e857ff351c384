//! What one state counts.
//!
//! To tell every line slows Lua down several times. So when only functions have run for a while whose lines have all run before, or that
//! are not counted at all, Lua is asked to tell calls and returns instead, until a function runs that may have something new. Which lines
//! have run is exact therefore, and how often is not: it is the least they did.

use std::cell::{Cell, RefCell};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;

use super::functions::Place;
use super::text::{Text, read_text};
use super::{CountedText, FunctionCache, LineCounts, executable};
use crate::script::instance::Script;
use crate::script::sim::Sim;

/// Texts of one state beyond which nothing is counted: Lua code can name any text.
const MAX_TEXTS: usize = 1000;
/// How many lines with nothing new are looked at before lines are no longer told.
const PATIENCE: u32 = 64;

/// What one state counts.
pub(crate) struct Coverage {
    /// Which functions stand where, as far as they have just run.
    pub functions: Rc<FunctionCache>,
    texts: RefCell<Vec<Text>>,
    own: RefCell<Option<Own>>,
    /// Lines told since the last one that could be new.
    idle: Cell<u32>,
    events: Cell<u64>,
    /// How often the count of instructions began anew before it was complete.
    lost_counts: Cell<u32>,
}

/// The script's own text.
struct Own {
    chunk_name: Vec<u8>,
    path: String,
    text: Arc<[u8]>,
}

impl Coverage {
    pub(crate) fn new() -> Self {
        Self {
            functions: Rc::new(FunctionCache::new()),
            texts: RefCell::default(),
            own: RefCell::default(),
            idle: Cell::new(0),
            events: Cell::new(0),
            lost_counts: Cell::new(0),
        }
    }

    /// The script's text is going to run under that name.
    pub(super) fn begin(&self, chunk_name: &str, path: String, text: &[u8]) {
        self.functions.clear();
        self.own.replace(Some(Own { chunk_name: chunk_name.into(), path, text: text.into() }));
    }

    /// Where the function stands that begins at a line of the text with that name; None when the text is not counted.
    pub(crate) fn place_of(&self, chunk_name: &[u8], line: i32) -> Option<Place> {
        let text = self.text_of(chunk_name)?;
        let line = u32::try_from(line).unwrap_or_default();
        Some(Place { text: text as u32, function: self.texts.borrow()[text].function_at(line) })
    }

    fn text_of(&self, chunk_name: &[u8]) -> Option<usize> {
        if let Some(known) = self.texts.borrow().iter().position(|text| *text.chunk_name == *chunk_name) {
            return Some(known);
        }
        let mut texts = self.texts.borrow_mut();
        if texts.len() >= MAX_TEXTS {
            return None;
        }
        let own = self.own.borrow();
        let text = match own.as_ref().filter(|own| own.chunk_name == chunk_name) {
            Some(own) => own.text.to_vec(),
            None => read_text(Path::new(&*String::from_utf8_lossy(chunk_name.strip_prefix(b"@")?)))?,
        };
        texts.push(Text::new(chunk_name, executable(&text).unwrap_or_default()));
        Some(texts.len() - 1)
    }

    /// A line runs at a place, or somewhere that is not counted; false when lines need not be told for now.
    pub(crate) fn line(&self, place: Option<Place>, line: i32) -> bool {
        self.events.set(self.events.get() + 1);
        if let Some(place) = place
            && let Some(text) = self.texts.borrow_mut().get_mut(place.text as usize)
        {
            text.count(line);
            if !text.is_complete(place.function) {
                self.idle.set(0);
                return true;
            }
        }
        self.idle.set(self.idle.get() + 1);
        let goes_on = self.idle.get() < PATIENCE;
        if !goes_on {
            self.idle.set(0);
        }
        goes_on
    }

    /// A function begins to run, or goes on, that stands there; whether its lines must be told.
    pub(crate) fn enter(&self, place: Option<Place>) -> bool {
        self.events.set(self.events.get() + 1);
        place.is_some_and(|place| {
            self.texts.borrow().get(place.text as usize).is_some_and(|text| !text.is_complete(place.function))
        })
    }

    /// The count of instructions begins anew, in the middle as a rule.
    pub(crate) fn note_lost_count(&self) {
        self.lost_counts.set(self.lost_counts.get() + 1);
    }

    /// Whether so many instructions were lost to the count that its hook should have come.
    pub(crate) fn is_late(&self) -> bool {
        let is_late = self.lost_counts.get() >= 2;
        if is_late {
            self.lost_counts.set(0);
        }
        is_late
    }

    /// Hands over what has been counted, and begins anew.
    pub(super) fn take(&self, sim: &Sim, script: &Script) -> LineCounts {
        let mut all = LineCounts { events: self.events.take(), ..LineCounts::default() };
        let own = self.own.borrow();
        for text in self.texts.borrow_mut().iter_mut() {
            let counts = std::mem::take(&mut text.counts);
            let counted = match own.as_ref().filter(|own| *own.chunk_name == *text.chunk_name) {
                Some(own) => own.counted(sim, script),
                None => CountedText::File(PathBuf::from(String::from_utf8_lossy(&text.chunk_name[1..]).into_owned())),
            };
            all.add(counted, &counts);
        }
        all
    }
}

impl Own {
    fn counted(&self, sim: &Sim, script: &Script) -> CountedText {
        let path = sim.path_of_script(script).unwrap_or_else(|| self.path.clone());
        CountedText::Script { scene: sim.scene_path(), path, text: Arc::clone(&self.text) }
    }
}
