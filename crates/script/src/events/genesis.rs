//! The snapshot: events from which a listener can reconstruct the scene (spec: events 7).

use std::rc::Rc;

use super::collect::LISTS;
use super::watch::{Listeners, Watched};
use crate::event_stream::data_entry;
use crate::event_stream::protocol::Protocol;
use crate::event_stream::queue::{Class, Event, Source};
use crate::host::Sim;
use scene::{Data, Namespace};

impl Sim {
    /// Application, scripts outside of the scene, the scene, its objects parents first, the main script.
    pub(crate) fn genesis(self: &Rc<Self>) -> Vec<Event> {
        let no_listeners = self.no_listeners();
        let (main, outside): (Vec<_>, Vec<_>) = self
            .scripts
            .all_detached()
            .iter()
            .map(|script| Watched::script(script, &no_listeners))
            .partition(|watched| watched.source.class == Class::Main);
        let mut events = vec![Event::new("genesisBegin", Source::NONE, Vec::new())];
        events.extend(self.genesis_of_app(&no_listeners));
        events.extend(
            outside
                .into_iter()
                .map(|mut script| self.detached_added(&mut script)),
        );
        events.push(self.genesis_of_scene(&no_listeners));
        for handle in self.scene.borrow().all_breadth_first() {
            let watched = self
                .scene
                .borrow()
                .object(handle)
                .map(|object| Watched::object(object, &no_listeners));
            events.extend(
                watched
                    .into_iter()
                    .flat_map(|mut watched| self.added(&mut watched)),
            );
        }
        events.extend(LISTS.map(Event::list));
        events.extend(
            main.into_iter()
                .map(|mut script| self.detached_added(&mut script)),
        );
        events.push(Event::new("genesisEnd", Source::NONE, Vec::new()));
        self.fill_in_lists(&mut events);
        events
    }

    fn genesis_of_app(self: &Rc<Self>, no_listeners: &Listeners) -> [Event; 2] {
        let mut app = Watched::app(no_listeners);
        let mut entries = app.describe(self);
        let params = self.app.borrow().named_params.clone();
        entries.extend(
            params
                .iter()
                .map(|(name, value)| self.named_param_entry(name, Some(value))),
        );
        entries.extend(app.stored(self, Namespace::Signal));
        let lasting = app.stored(self, Namespace::CustomData);
        [entries, lasting].map(|entries| Event::new("objectChanged", Source::APP, entries))
    }

    fn genesis_of_scene(self: &Rc<Self>, no_listeners: &Listeners) -> Event {
        let mut scene = Watched::scene(no_listeners);
        let mut entries = scene.describe(self);
        for namespace in [Namespace::CustomData, Namespace::Signal] {
            entries.extend(scene.stored(self, namespace));
        }
        Event::new("objectChanged", Source::SCENE, entries)
    }

    /// Introduces a script that is no object.
    pub(super) fn detached_added(self: &Rc<Self>, script: &mut Watched) -> Event {
        let key = match self.events.protocol.get() {
            Protocol::V3 => "objectType",
            Protocol::V4 => "type",
        };
        let mut entries = vec![data_entry(key, &Data::text("detachedScript"))];
        entries.extend(script.describe(self));
        Event::new("objectAdded", script.source, entries)
    }
}
