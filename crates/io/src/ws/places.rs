//! The places of a server: how many connections it has at most, and which of them give way to a new one.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::{OwnedSemaphorePermit, Semaphore, oneshot};

/// The places of one server.
pub(super) struct Places {
    free: Arc<Semaphore>,
    silent: Arc<Silent>,
}

/// A place, as long as a connection has it.
pub(super) struct Place {
    silent: Arc<Silent>,
    /// It is silent from the beginning, even before its task runs.
    beginning: Option<Silence>,
    _permit: OwnedSemaphorePermit,
}

/// Connections that owe a request, in the order in which they became silent, with what ends them.
#[derive(Default)]
struct Silent(Mutex<(u64, BTreeMap<u64, oneshot::Sender<()>>)>);

impl Places {
    pub(super) fn new(count: usize) -> Self {
        Self {
            free: Arc::new(Semaphore::new(count)),
            silent: Arc::default(),
        }
    }

    /// A place for a connection that has come. If none is free, the one that has been silent for longest loses its place; where all have said
    /// something, the first that ends.
    pub(super) async fn take(&self) -> Option<Place> {
        if self.free.available_permits() == 0 {
            self.end_silent();
        }
        let permit = Arc::clone(&self.free).acquire_owned().await.ok()?;
        Some(Place {
            silent: Arc::clone(&self.silent),
            beginning: Some(Silence::begin(&self.silent)),
            _permit: permit,
        })
    }

    /// Ends the connection that has been silent for longest: there is no room.
    pub(super) fn end_silent(&self) {
        if let Some((_, end)) = self.silent.lock().1.pop_first() {
            // One that has just spoken does not listen any more, and goes on.
            let _ = end.send(());
        }
    }
}

impl Place {
    /// Waits for what the peer says; none when it has to give way before.
    pub(super) async fn receive<T>(&mut self, said: impl Future<Output = T>) -> Option<T> {
        let begin = || Silence::begin(&self.silent);
        let mut silence = self.beginning.take().unwrap_or_else(begin);
        tokio::select! {
            biased;
            said = said => Some(said),
            _ = &mut silence.ended => None,
        }
    }
}

impl Silent {
    /// Whole even if a thread that held it panicked: entries are only added and removed.
    fn lock(&self) -> MutexGuard<'_, (u64, BTreeMap<u64, oneshot::Sender<()>>)> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A connection is listed as long as this lives.
struct Silence {
    silent: Arc<Silent>,
    number: u64,
    ended: oneshot::Receiver<()>,
}

impl Silence {
    fn begin(silent: &Arc<Silent>) -> Self {
        let (end, ended) = oneshot::channel();
        let mut entries = silent.lock();
        entries.0 += 1;
        let number = entries.0;
        entries.1.insert(number, end);
        drop(entries);
        Self {
            silent: Arc::clone(silent),
            number,
            ended,
        }
    }
}

impl Drop for Silence {
    fn drop(&mut self) {
        self.silent.lock().1.remove(&self.number);
    }
}

#[cfg(test)]
mod tests {
    use std::future::{pending, ready};
    use std::time::Duration;

    use tokio::time::timeout;

    use super::Places;

    #[tokio::test]
    async fn the_one_that_is_silent_for_longest_gives_way() {
        let places = Places::new(2);
        let (mut first, mut second) = (places.take().await.unwrap(), places.take().await.unwrap());
        assert_eq!(first.receive(ready(7)).await, Some(7));
        let talks = tokio::spawn(async move { second.receive(pending::<()>()).await });
        let later = tokio::spawn(async move {
            tokio::task::yield_now().await;
            first.receive(pending::<()>()).await
        });
        tokio::task::yield_now().await;
        tokio::task::yield_now().await;
        let third = timeout(Duration::from_secs(60), places.take()).await;
        assert_eq!(talks.await.unwrap(), None);
        assert!(third.unwrap().is_some() && !later.is_finished());
    }

    #[tokio::test]
    async fn connections_that_have_spoken_keep_their_places() {
        let places = Places::new(1);
        let mut place = places.take().await.unwrap();
        assert_eq!(place.receive(ready(())).await, Some(()));
        let waits = timeout(Duration::from_millis(20), places.take()).await;
        assert!(waits.is_err(), "there is none to give way");
        drop(place);
        assert!(places.take().await.is_some());
    }
}
