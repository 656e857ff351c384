//! Heaps: what comes back, whose memory a block is, what is refused.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use super::resource::Resource;
use super::{Allocator, Heap, Outer, RestoreError, in_scripts, outside};

#[global_allocator]
static ALLOCATOR: Allocator = Allocator;

fn heap() -> Heap {
    Heap::new().expect("the tests declare the allocator")
}

/// Something with many blocks of many sizes.
type World = Rc<RefCell<BTreeMap<usize, Vec<String>>>>;

fn change(world: &World, round: usize) {
    let mut map = world.borrow_mut();
    for key in 0..200 {
        let list = map.entry(key * 7 % 101).or_default();
        if (key + round).is_multiple_of(3) {
            list.clear();
            list.shrink_to_fit();
        } else {
            list.push("x".repeat(key * round % 5000));
        }
    }
}

fn shown(world: &World) -> String {
    format!("{:?}", world.borrow())
}

#[test]
fn a_restored_heap_goes_on_as_it_did_before() {
    let heap = heap();
    let world = heap.enter(World::default);
    heap.enter(|| (0..5).for_each(|round| change(&world, round)));
    let first = heap.snapshot().expect("nothing is open");
    let before = shown(&world);
    let mut runs = Vec::new();
    for _ in 0..3 {
        heap.enter(|| (5..9).for_each(|round| change(&world, round)));
        let place = heap.enter(|| Box::into_raw(Box::new([0_u64; 9])).addr());
        runs.push((shown(&world), place, heap.usage()));
        // SAFETY: nothing outside refers to what the rounds made.
        unsafe { heap.restore(&first) }.expect("nothing is open");
        assert_eq!(shown(&world), before);
    }
    assert_eq!(runs[0], runs[1]);
    assert_eq!(runs[1], runs[2]);
    assert_ne!(runs[0].0, before);
    heap.enter(|| drop(world));
}

#[test]
fn memory_that_was_never_used_takes_none_in_a_snapshot() {
    let heap = heap();
    let list = heap.enter(|| vec![1_u8; 10_000]);
    let snapshot = heap.snapshot().expect("nothing is open");
    assert!(
        (10_000..40_000).contains(&snapshot.own_bytes()),
        "{}",
        snapshot.own_bytes()
    );
    heap.enter(|| drop(list));
}

#[test]
fn an_earlier_snapshot_can_be_brought_back_after_a_later_one() {
    let heap = heap();
    let value = heap.enter(|| Rc::new(RefCell::new(vec![1; 10_000])));
    let first = heap.snapshot().expect("nothing is open");
    heap.enter(|| value.borrow_mut().fill(2));
    let second = heap.snapshot().expect("nothing is open");
    let set = |number| heap.enter(|| value.borrow_mut().fill(number));
    set(3);
    for (snapshot, number) in [(&first, 1), (&second, 2), (&first, 1), (&second, 2)] {
        // SAFETY: nothing was made after the first snapshot.
        unsafe { heap.restore(snapshot) }.expect("nothing is open");
        assert_eq!(*value.borrow(), vec![number; 10_000]);
        set(4);
    }
    assert!(second.own_bytes() < 80_000 && second.own_bytes() > 30_000);
    heap.enter(|| drop(value));
}

#[test]
fn addresses_of_scripts_do_not_depend_on_other_memory() {
    let place_after = |noise: usize| {
        let heap = heap();
        heap.enter(|| {
            let other = vec![0_u8; noise];
            let place = in_scripts(|| Box::new([1_u8; 100]));
            drop(other);
            std::ptr::from_ref(&*place).addr() & 0xffff_ffff
        })
    };
    assert_eq!(place_after(1), place_after(3_000_000));
}

#[test]
fn blocks_of_all_sizes_are_apart_and_keep_their_bytes() {
    let heap = heap();
    heap.enter(|| {
        let sizes = (1..700).chain([4096, 70_000, 1 << 20, 5 << 20]);
        let mut blocks: Vec<Vec<u8>> = sizes.map(|size| vec![size as u8; size]).collect();
        for block in &mut blocks {
            let byte = block[0];
            block.extend(std::iter::repeat_n(byte, block.len()));
        }
        for (at, block) in blocks.iter().enumerate() {
            assert!(block.iter().all(|byte| *byte == block[0]), "{at}");
        }
        blocks.retain(|block| block.len() % 3 == 0);
        for block in &mut blocks {
            block.truncate(block.len() / 2);
            block.shrink_to_fit();
        }
        assert!(
            blocks
                .iter()
                .all(|block| block.iter().all(|byte| *byte == block[0]))
        );
    });
    assert_eq!(heap.usage(), (0, 0));
}

#[test]
fn threads_that_work_for_the_owner_are_inside_as_well() {
    let heap = heap();
    let lists = heap.enter(|| {
        let handle = super::Handle::current().expect("inside").shared();
        outside(|| {
            std::thread::scope(|scope| {
                let work = move |thread: usize| {
                    let _entered = handle.entered();
                    (0..2000).map(|i| vec![thread; i % 60]).collect::<Vec<_>>()
                };
                let threads: Vec<_> = (0..4)
                    .map(|thread| scope.spawn(move || work(thread)))
                    .collect();
                let results = threads
                    .into_iter()
                    .map(|thread| thread.join().expect("no panic"));
                results.collect::<Vec<_>>()
            })
        })
    });
    for (thread, list) in lists.iter().enumerate() {
        assert!(list.iter().flatten().all(|item| *item == thread));
    }
    assert!(heap.usage().1 > 7000);
    // Freed by the thread outside: they are put aside until the next allocation.
    drop(lists);
    heap.enter(|| drop(std::hint::black_box(Box::new(1))));
    assert!(heap.usage().1 < 1000, "{:?}", heap.usage());
}

#[test]
fn what_is_open_is_named() {
    let heap = heap();
    let socket = heap.enter(|| Resource::new(|| "the socket tcp://127.0.0.1:9".to_owned()));
    let refused = heap.snapshot().err();
    assert_eq!(
        refused,
        Some(RestoreError::Open(vec![
            "the socket tcp://127.0.0.1:9".into()
        ]))
    );
    drop(socket);
    let snapshot = heap.snapshot().expect("it is closed");
    let other = super::tests::heap();
    // SAFETY: it is refused.
    let refused = unsafe { other.restore(&snapshot) };
    assert_eq!(refused, Err(RestoreError::OtherHeap));
}

#[test]
fn nothing_is_brought_back_below_a_call() {
    let heap = heap();
    let snapshot = heap.snapshot().expect("nothing is open");
    // SAFETY: it is refused.
    let restored = || unsafe { heap.restore(&snapshot) };
    assert_eq!(heap.enter(restored), Err(RestoreError::Inside));
    // What the call has called would return into memory that is another.
    assert_eq!(heap.enter(|| outside(restored)), Err(RestoreError::Inside));
    let taken = heap.enter(|| outside(|| heap.snapshot().err()));
    assert_eq!(taken, Some(RestoreError::Inside));
    let handle = heap.handle();
    let entered = (handle.entered(), heap.entered());
    drop(entered.0);
    assert_eq!(restored(), Err(RestoreError::Inside));
    drop(entered.1);
    assert_eq!(restored(), Ok(()));
}

#[test]
fn values_of_the_program_outlive_what_can_be_brought_back() {
    let value = Rc::new(String::from("the program's"));
    let heap = heap();
    let held = heap.enter(|| Rc::new(Cell::new(Some(Outer::new(outside(|| Rc::clone(&value)))))));
    let snapshot = heap.snapshot().expect("nothing is open");
    heap.enter(|| drop(held.take()));
    // SAFETY: nothing outside refers to what came after.
    unsafe { heap.restore(&snapshot) }.expect("nothing is open");
    let outer = held.take().expect("it is back");
    assert_eq!(outer.with(|value| value.len()), 13);
    assert_eq!(Rc::strong_count(&value), 2);
    heap.end();
    heap.enter(|| drop((outer, held)));
    assert_eq!(Rc::strong_count(&value), 1, "no snapshot keeps it now");
}

#[test]
fn with_snapshots_no_block_crosses_the_border() {
    let heap = heap();
    let (inner, outer) = (heap.enter(|| vec![7_u8; 1000]), vec![8_u8; 1000]);
    let snapshot = heap.snapshot().expect("nothing is open");
    let usage = heap.usage();
    drop(inner);
    heap.enter(|| drop(outer));
    heap.enter(|| drop(std::hint::black_box(Box::new(1))));
    assert_eq!(heap.usage(), usage);
    drop(snapshot);
}
