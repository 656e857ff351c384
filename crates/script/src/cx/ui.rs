//! Windows of scripts.

use std::cell::RefCell;
use std::rc::{Rc, Weak};

use super::Cx;
use crate::error::ApiResult;
use scene::Data;
use ui::{Question, Ui, UiResult, Window};

/// What a script has opened: it goes with the state of the script.
#[derive(Default)]
struct Opened(RefCell<Vec<Ownership>>);

struct Ownership {
    ui: Weak<RefCell<Ui>>,
    item: Item,
}

enum Item {
    Window(String),
    Banner(i64),
    View(i64),
}

impl Drop for Ownership {
    fn drop(&mut self) {
        if let Some(ui) = self.ui.upgrade()
            && let Ok(mut ui) = ui.try_borrow_mut()
        {
            // It may have been destroyed before.
            let _ = match &self.item {
                Item::Window(window) => ui.destroy(window).is_ok(),
                Item::Banner(banner) => ui.dialogs.remove_banner(*banner),
                Item::View(view) => ui.views.remove(*view),
            };
            ui.touch();
        }
    }
}

impl Cx<'_> {
    /// Reads from the windows of scripts.
    pub fn read_ui<T>(&self, read: impl FnOnce(&Ui) -> T) -> T {
        let ui = self.app().ui.clone();
        read(&ui.borrow())
    }

    /// Changes the windows of scripts.
    pub fn change_ui<T>(&mut self, change: impl FnOnce(&mut Ui) -> T) -> T {
        let ui = self.app().ui.clone();
        change(&mut ui.borrow_mut())
    }

    /// The windows of scripts, for what changes them between calls.
    pub fn windows(&self) -> Rc<RefCell<Ui>> {
        self.app().ui.clone()
    }

    /// Destroys a window when the calling script ends.
    pub fn own_window(&mut self, window: &str) {
        self.own(Item::Window(window.to_owned()));
    }

    /// Removes a banner when the calling script ends.
    pub fn own_banner(&mut self, banner: i64) {
        self.own(Item::Banner(banner));
    }

    /// Removes a floating view when the calling script ends.
    pub fn own_view(&mut self, view: i64) {
        self.own(Item::View(view));
    }

    /// The user's answer to a dialog; None without one.
    pub fn ask_person(&mut self, question: &Question) -> Option<Data> {
        self.sim.ask_person(question)
    }

    fn own(&mut self, item: Item) {
        let ui = self.app().ui.clone();
        let opened = self.script_state::<Opened>();
        let mut opened = opened.0.borrow_mut();
        opened.retain(|other| match &other.item {
            Item::Window(window) => ui.borrow().window(window).is_ok(),
            Item::Banner(banner) => ui.borrow().dialogs.has_banner(*banner),
            Item::View(view) => ui.borrow().views.contains(*view),
        });
        opened.push(Ownership {
            ui: Rc::downgrade(&ui),
            item,
        });
    }

    /// Reads a window.
    ///
    /// # Errors
    /// When there is no such window, or those of `read`.
    pub fn read_window<T>(
        &self,
        handle: &str,
        read: impl FnOnce(&Window) -> UiResult<T>,
    ) -> ApiResult<T> {
        Ok(self.read_ui(|ui| ui.window(handle).and_then(read))?)
    }

    /// Changes a window.
    ///
    /// # Errors
    /// When there is no such window, or those of `change`.
    pub fn change_window<T>(
        &mut self,
        handle: &str,
        change: impl FnOnce(&mut Window) -> UiResult<T>,
    ) -> ApiResult<T> {
        Ok(self.change_ui(|ui| ui.change(handle, change))?)
    }

    /// Calls the handlers of the events of windows that wait.
    pub fn deliver_ui_events(&mut self) {
        self.sim.deliver_ui_events();
    }
}
