//! Planners, by the names under which they are known.

mod connect;
mod expansive;
mod fmt;
mod grid;
mod lazy_roadmap;
mod roadmap;
mod rrt;
mod rrt_star;
mod subdivision;

use crate::{Problem, Refusal, Solution, State};

/// What a planner has found out so far.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlannerData {
    /// All states that were reached.
    pub states: Vec<State>,
    /// Of each state: 1 for a tree from the starts, 2 for one from the goals, where there are both; else 0.
    pub tags: Vec<u32>,
    /// Pairs of places.
    pub edges: Vec<(usize, usize)>,
    /// Places of starts in `states`.
    pub starts: Vec<usize>,
    /// Places of goals in `states`.
    pub goals: Vec<usize>,
}

/// A planner, which goes on where it has ended when it is asked again.
pub trait Planner {
    /// Plans for at most so many iterations, or until the world has enough. The best path so far; None where there is none.
    ///
    /// # Errors
    /// When there is nothing to plan.
    fn solve(
        &mut self,
        problem: &mut Problem<'_>,
        iterations: u64,
    ) -> Result<Option<Solution>, Refusal>;

    /// Forgets starts, goals and the path. Only a roadmap is worth keeping then (`Algorithm::keeps_roadmap`): others know nothing but ways from the start.
    fn clear_query(&mut self) {}

    /// What was found out.
    fn data(&self) -> PlannerData;
}

/// The names of planners, with the numbers they have in simOMPL.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Algorithm {
    /// Bidirectional transition-based RRT.
    BiTrrt = 30001,
    /// Batch informed trees.
    BitStar = 30002,
    /// KPIECE with a tree from each end and one level of cells.
    Bkpiece1 = 30003,
    /// Coupled forests of RRT*.
    CForest = 30004,
    /// Expansive space trees.
    Est = 30005,
    /// Fast marching trees.
    Fmt = 30006,
    /// Kinodynamic planning by interior-exterior cell exploration, with one level of cells.
    Kpiece1 = 30007,
    /// PRM that checks motions only when a path uses them.
    LazyPrm = 30008,
    /// PRM* that checks motions only when a path uses them.
    LazyPrmStar = 30009,
    /// RRT that checks motions only when a path uses them.
    LazyRrt = 30010,
    /// BKPIECE1 that checks motions only when a path uses them.
    Lbkpiece1 = 30011,
    /// Lower bound tree RRT.
    LbtRrt = 30012,
    /// Path-directed subdivision trees.
    Pdst = 30013,
    /// Probabilistic roadmap.
    Prm = 30014,
    /// Asymptotically optimal PRM.
    PrmStar = 30015,
    /// Rapidly exploring random tree.
    Rrt = 30016,
    /// RRT with a tree from each end that are grown towards each other.
    RrtConnect = 30017,
    /// Asymptotically optimal RRT.
    RrtStar = 30018,
    /// Single-query bidirectional lazy planning.
    Sbl = 30019,
    /// Sparse roadmap spanner.
    Spars = 30020,
    /// Sparse roadmap spanner that keeps no dense roadmap.
    SparsTwo = 30021,
    /// Search tree with resolution independent density estimation.
    Stride = 30022,
    /// Transition-based RRT.
    Trrt = 30023,
}

impl Algorithm {
    /// All algorithms, in the order of their numbers.
    pub const ALL: [Self; 23] = [
        Self::BiTrrt,
        Self::BitStar,
        Self::Bkpiece1,
        Self::CForest,
        Self::Est,
        Self::Fmt,
        Self::Kpiece1,
        Self::LazyPrm,
        Self::LazyPrmStar,
        Self::LazyRrt,
        Self::Lbkpiece1,
        Self::LbtRrt,
        Self::Pdst,
        Self::Prm,
        Self::PrmStar,
        Self::Rrt,
        Self::RrtConnect,
        Self::RrtStar,
        Self::Sbl,
        Self::Spars,
        Self::SparsTwo,
        Self::Stride,
        Self::Trrt,
    ];

    /// The algorithm with that number.
    pub fn from_number(number: i64) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|algorithm| *algorithm as i64 == number)
    }

    /// Whether it makes its path shorter until it is stopped.
    pub fn is_optimising(self) -> bool {
        use Algorithm as A;
        matches!(
            self,
            A::BitStar
                | A::CForest
                | A::LazyPrmStar
                | A::LbtRrt
                | A::PrmStar
                | A::RrtStar
                | A::Spars
                | A::SparsTwo
        )
    }

    /// Whether it keeps a roadmap from one start to the next.
    pub fn keeps_roadmap(self) -> bool {
        matches!(self, Self::Prm | Self::PrmStar)
    }

    /// Whether it needs a projection.
    pub fn needs_projection(self) -> bool {
        use Algorithm as A;
        matches!(
            self,
            A::Kpiece1 | A::Bkpiece1 | A::Lbkpiece1 | A::Sbl | A::Pdst
        )
    }

    /// A planner. Names with the same guarantee share an implementation: CForest and LBTRRT are RRT*, SPARS and SPARStwo are PRM*, STRIDE is
    /// EST; BIT* and LazyPRM* differ in where they sample.
    pub fn planner(self) -> Box<dyn Planner> {
        use Algorithm as A;
        match self {
            A::Rrt => Box::new(rrt::Rrt::new(rrt::Kind::Plain)),
            A::LazyRrt => Box::new(rrt::Rrt::new(rrt::Kind::Lazy)),
            A::Trrt => Box::new(rrt::Rrt::new(rrt::Kind::Transition)),
            A::RrtConnect => Box::new(connect::Connect::new(false)),
            A::BiTrrt => Box::new(connect::Connect::new(true)),
            A::RrtStar | A::CForest | A::LbtRrt => {
                Box::new(rrt_star::RrtStar::new(self == A::CForest))
            }
            A::Prm => Box::new(roadmap::Roadmap::new(false)),
            A::PrmStar | A::Spars | A::SparsTwo => Box::new(roadmap::Roadmap::new(true)),
            A::LazyPrm => Box::new(lazy_roadmap::LazyRoadmap::new(lazy_roadmap::Kind::First)),
            A::LazyPrmStar => Box::new(lazy_roadmap::LazyRoadmap::new(lazy_roadmap::Kind::Optimal)),
            A::BitStar => Box::new(lazy_roadmap::LazyRoadmap::new(lazy_roadmap::Kind::Informed)),
            A::Kpiece1 => Box::new(grid::Single::default()),
            A::Pdst => Box::new(subdivision::Subdivision::default()),
            A::Bkpiece1 => Box::new(grid::Double::new(grid::Kind::Bkpiece)),
            A::Lbkpiece1 => Box::new(grid::Double::new(grid::Kind::Lbkpiece)),
            A::Sbl => Box::new(grid::Double::new(grid::Kind::Sbl)),
            A::Est | A::Stride => Box::new(expansive::Expansive::default()),
            A::Fmt => Box::new(fmt::FastMarching::default()),
        }
    }
}

/// Part of the samples that are states of the goal.
const GOAL_BIAS: f64 = 0.05;

/// The longest step of planners, as a part of the extent.
const RANGE: f64 = 0.2;

/// The longest step of planners that test transitions.
const COST_RANGE: f64 = 0.175;

/// A state that is at least this part of the extent away explores; nearer ones refine.
const FRONTIER: f64 = 0.01;

/// The ratio of states that refine to those that explore.
const FRONTIER_RATIO: f64 = 0.1;

/// Keeps the best of the paths found so far.
fn keep_best(best: &mut Option<Solution>, found: Solution, problem: &Problem<'_>) {
    if best
        .as_ref()
        .is_none_or(|best| found.is_better(best, problem.space))
    {
        *best = Some(found);
    }
}
