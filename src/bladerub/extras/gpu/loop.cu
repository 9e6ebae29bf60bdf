// The time loop of single runs, a warp a run, by the contract of `bladerub.contact.schemes`.
//
// It makes the steps of `bladerub.contact.kernel` for a scheme that does not correct, deformable elements and
// a force of constant direction; a run that it can't go on with is HANDED_OVER. Its functions are named as
// those there. The formulas of law, profile and contact force are not written here: they are translated from
// Python (`bladerub.extras.gpu.formulas`) and stand before this text, with the constants in capitals.
//
// A lane is node j = lane % 8 in group = lane / 8 and holds the modes lane, lane + 32, ... The groups share
// the rows of elements under a node: of its window, a group has each fourth row.

constexpr int NODES = 8, GROUPS = 4;
constexpr int STRIDE = LANES * MODES;  // of rows of modes
constexpr int SUMS = TURNS ? 24 : 16;  // displacements of the tip: radial, tangential, tilt
constexpr int OF_NODE = TURNS ? 12 : 8, OF_TILT = TURNS ? 6 : 0;  // forces that a lane sums the effects of
// Parts of the record of modes, of the record of the stator and of that of the tip
constexpr int TIP_ROWS = 4 * STRIDE, FORMS = TIP_ROWS + SUMS * STRIDE, RESPONSE = FORMS + N_FORMS * STRIDE;
constexpr int FLIGHT = RESPONSE + LANES * (OF_NODE + OF_TILT), MODAL_SIZE = FLIGHT + 2;
constexpr int SELF = NODES * LAW_FIELDS, FACTORS = SELF + 2 * NODES, STATOR_SIZE = FACTORS + 2;
constexpr int TIP_SIZE = 4 * NODES + 4;
// Rows of the ledger that the lanes keep, in shared memory. In the first two a group has an entry of its own:
// work of the radial and the tangential forces, sliding, torque; exchanged, retreat, work of the couples. In
// the others the groups have parts of one.
enum { OF_WORK, OF_REST, SHAPE, WEAR, STORED, STORED_BEFORE, LAST_SHAPE, LAST_WEAR, KEPT };
static_assert(SHARED == 24 + LANES * KEPT + (4 + SUMS) * STRIDE, "doubles of a warp");
constexpr int NO_ROW = -1000000;
enum { COMPLETED, UNBOUNDED, HANDED_OVER };
enum { STATUS, REVOLUTIONS, STEPS, LAST_STEPS, CONTACT_STEPS, REVERSED_STEPS, COUNTS };
enum { OF_MODAL, OF_STATOR, OF_CASING, OF_TIP, STEPS_PER_ELEMENT, RECORDS };

// A piece of work: runs of one size
struct Batch {
  long long n_elements, revolutions;
  const double *modal, *stator, *casing, *tip;  // records, one after the other
  const int* runs;  // (n, RECORDS): numbers of the records of each run, and its steps in an element
  double* modes;    // (n, 2, STRIDE): modal coordinates and their last increment, at the start and the end
  double* wear;     // (n, N, 8), m; 0 at the start
  double* displacement;  // (n, revolutions N): of node 1, mean over each element, m
  double* range;         // (n, revolutions, 2): of that displacement, m
  double* forces;        // (n, 2, 24): on the blade now and one step before
  double* ledger;        // (n, KEPT + 1, 32): its rows, and the damping loss
  long long* counts;     // (n, COUNTS)
};
struct Node {
  real start, per_metre, radius, lever;
};
struct Place {
  real radial, tangential, approach, tilt;
};
// On the blade; `normal` is their size, `moment` that about the axis
struct Forces {
  real radial, tangential, couple, normal, moment;
};
// Of the elements under a node, those of the group: rows `row`, `row` + 4, ...
struct Window {
  integer row;
  real gap[ROWS], worn[ROWS];
};
struct Linearisation {
  real force, stiffness, valid, couple, first_moment, second_moment;
};

// What a run is: its records, as the lanes hold them
struct Model {
  const double *coefficients, *tips, *forms;  // in shared memory, but for the forms of a free flight
  double *forces, *ledger, *wear;
  const double* gap;
  Node node;
  Profile tip;
  Element element;
  real self_compliance, tilt_compliance, response[OF_NODE + OF_TILT];
  double search_range, limit, normal_factor, tangential_factor, sideways, per_step, angle;
  int n_elements, flight_steps;
};
// What changes in it
struct State {
  real q[MODES], d[MODES], damping;  // modal coordinates, their last increment
  Place now, before, response;       // of the tip; by the forces of the last step in that step
  Forces force, force_before;
  Window window;
  bool touching;
  int reversed;
};

// Sum, and least, over the groups of each node
HERE real in_node(real a) {
  a += exchange(a, 8);
  return a + exchange(a, 16);
}
HERE real least_in_node(real a) {
  a = minimum(a, exchange(a, 8));
  return minimum(a, exchange(a, 16));
}
HERE integer wrap(integer row, int n) { return choose(row >= n, row - n, choose(row < 0, row + n, row)); }

// Displacement of the tip, the interface rows of eq. (6), by modal coordinates. Slot s has the row s ^ mask,
// so that each exchange halves what is left to add, and a lane ends with its node.
HERE Place project(const double* tips, const real (&x)[MODES], const Node& node) {
  real a[SUMS];
#pragma unroll
  for (int s = 0; s < SUMS; s++) {
    a[s] = load(tips, lane() + LANES * s) * x[0];
#pragma unroll
    for (int m = 1; m < MODES; m++) a[s] += load(tips, lane() + LANES * (SUMS * m + s)) * x[m];
  }
#pragma unroll
  for (int s = 0; s < 8; s++) a[s] += exchange(a[s + 8], 16);
#pragma unroll
  for (int half = 4; half; half >>= 1)
#pragma unroll
    for (int s = 0; s < half; s++) a[s] += exchange(a[s + half], half);
  a[0] += exchange(a[0], 8);
  real other = exchange(a[0], 16);
  flag upper = lane() >= 16;
  Place place;
  place.radial = where(upper, other, a[0]);
  place.tangential = where(upper, a[0], other);
  real outward = node.radius + place.radial;
  place.approach = sqrt_of(outward * outward + place.tangential * place.tangential) - node.radius;
  place.tilt = 0.0;
  if (TURNS) {
#pragma unroll
    for (int half = 4; half; half >>= 1)
#pragma unroll
      for (int s = 0; s < half; s++) a[16 % SUMS + s] += exchange(a[16 % SUMS + s + half], half);
    place.tilt = in_node(a[16 % SUMS]);
  }
  return place;
}

HERE real closest_position(const Node& node, real tangential, double passed) {  // eq. (7)
  return node.start + passed + tangential * node.per_metre;
}

HERE integer group_of() { return lane() >> 3; }
HERE flag in_upper() { return lane() >= 16; }
HERE flag in_odd() { return (lane() & 8) != 0; }
HERE flag everywhere() { return lane() >= 0; }

HERE real entry(const Model& model, int row) { return load(model.ledger + LANES * row, lane()); }
HERE void set_entry(const Model& model, int row, real value) {
  store(model.ledger + LANES * row, lane(), value, everywhere());
}
HERE void add_entry(const Model& model, int row, real value) {
  set_entry(model, row, entry(model, row) + value);
}
HERE real by_group(real a, real b, real c, real d) {
  return where(in_upper(), where(in_odd(), d, c), where(in_odd(), b, a));
}

HERE bool is_within_limit(const Model& model, real radial, real tangential) {
  return all((absolute(radial) <= model.limit) & (absolute(tangential) <= model.limit));
}

// Whether the tip surely touches nothing where it is, or within `far` of there
HERE bool is_clear(const Model& model, const Place& place, real far, double minimum_gap) {
  real closest = place.approach + far, sideways = absolute(place.tangential) + model.sideways * far;
  bool clear =
      all((closest <= minimum_gap) & (sideways <= model.search_range) & (place.radial - far > -model.limit));
  if (TURNS && clear) clear = all(closest + highest(model.tip, absolute(place.tilt)) <= minimum_gap);
  return clear;
}

// Bound of what any node can approach the casing in the next free flight
HERE real bound(const Model& model, const State& state) {
  real far = 0.0;
#pragma unroll
  for (int m = 0; m < MODES; m++) {
    far += load(model.forms + BOUND_Q * MODES, lane() + LANES * m) * absolute(state.q[m]);
    far += load(model.forms + BOUND_D * MODES, lane() + LANES * m) * absolute(state.d[m]);
  }
  return total(far);
}

// Make many steps at once, as `bladerub.contact.kernel.free_flight`; `far` becomes the bound of the next
// flight
HERE void fly(const Model& model, State& state, real& far, real& mean, real& bottom, real& top) {
#define FORM(i) load(model.forms + (i)*MODES, lane() + LANES * m)
  real start = state.now.radial, increment = 0.0;
  far = 0.0;
#pragma unroll
  for (int m = 0; m < MODES; m++) {
    real present = state.q[m], last = state.d[m];
    state.damping += (FORM(LOSS_QQ) * present + FORM(LOSS_QD) * last) * present + FORM(LOSS_DD) * last * last;
    increment += FORM(MEAN_Q) * present + FORM(MEAN_D) * last;
    state.q[m] = present + (FORM(INCREMENT_Q) * present + FORM(INCREMENT_D) * last);
    state.d[m] = FORM(LAST_STEP_Q) * present + FORM(LAST_STEP_D) * last;
    far += FORM(BOUND_Q) * absolute(state.q[m]) + FORM(BOUND_D) * absolute(state.d[m]);
  }
#undef FORM
  // Two sums over all lanes: one in each half of them
  real mine = where(in_upper(), far, increment) + exchange(where(in_upper(), increment, far), 16);
#pragma unroll
  for (int bit = 8; bit; bit >>= 1) mine += exchange(mine, bit);
  real other = exchange(mine, 16);
  far = where(in_upper(), mine, other);
  increment = where(in_upper(), other, mine);
  state.now = project(model.tips, state.q, model.node);
  mean += model.flight_steps * (start + increment);
  // The range of the parabola that has this mean
  real end = state.now.radial, middle = 0.5 * (start + end), bulge = start + increment - middle;
  flag turns = absolute(end - start) < 6.0 * absolute(bulge);
  real vertex = middle + 1.5 * bulge + (end - start) * (end - start) / (24.0 * where(turns, bulge, 1.0));
  vertex = where(turns, vertex, end);
  bottom = minimum(bottom, minimum(minimum(start, end), vertex));
  top = maximum(top, maximum(maximum(start, end), vertex));
}

// Increment of the modes in one step, under the forces of the step before where there was contact
HERE void advance(const Model& model, const State& state, bool touched, real (&x)[MODES]) {
#pragma unroll
  for (int m = 0; m < MODES; m++) {
    x[m] = load(model.coefficients, lane() + LANES * m) * state.q[m] +
           load(model.coefficients + STRIDE, lane() + LANES * m) * state.d[m];
  }
  if (!touched) return;
  const integer j = lane() & 7, mask = j + (group_of() >> 1) * NODES;
  real by_forces[MODES];
#pragma unroll
  for (int m = 0; m < MODES; m++) by_forces[m] = 0.0;
#pragma unroll
  for (int s = 0; s < SUMS; s++) {
    real force = load(model.forces, s < 16 ? mask ^ s : (j ^ (s - 16)) + 16);
#pragma unroll
    for (int m = 0; m < MODES; m++) by_forces[m] += load(model.tips, lane() + LANES * (SUMS * m + s)) * force;
  }
#pragma unroll
  for (int m = 0; m < MODES; m++)
    x[m] += load(model.coefficients + 3 * STRIDE, lane() + LANES * m) * by_forces[m];
}

// Elements that a node may move in a step and leave the window over all elements under its profile
HERE real farthest(const Profile& tip) { return 4.0 * ROWS - 2.0 * tip.half_width - 1.5; }

// Find the elements under the nodes: the window begins where the first one under `position` is
HERE void look(const Model& model, Window& window, real position) {
  integer first = floor_of(position - model.tip.half_width);
  integer row = first + ((group_of() - first) & 3);
  if (any(row != window.row)) {
    window.row = row;
#pragma unroll
    for (int k = 0; k < ROWS; k++) {
      integer at = wrap(row + GROUPS * k, model.n_elements) * NODES + (lane() & 7);
      window.gap[k] = load(model.gap, at);
      window.worn[k] = load(model.wear, at);
    }
  }
}

HERE Linearisation linearise(const Model& model, const Window& window, real position, real approach,
                             real tilt) {
  Linearisation all{0.0, 0.0, INFINITY, 0.0, 0.0, 0.0};
#pragma unroll
  for (int k = 0; k < ROWS; k++) {
    real offset = real_of(window.row + GROUPS * k) + 0.5 - position, share = coverage(model.tip, offset);
    real here = TURNS ? approach + tilt * offset : approach;
    real depth = penetration(here, relief(model.tip, offset), window.gap[k], window.worn[k]);
    real force = return_mapping(model.element, depth, window.worn[k]).first;
    Pair slope = tangent(model.element, depth, window.worn[k]);
    all.force += share * force;
    all.stiffness += share * slope.first;
    all.valid = minimum(all.valid, where(share > 0.0, slope.second, INFINITY));
    if (TURNS) {
      all.couple += share * offset * force;
      all.first_moment += share * offset * slope.first;
      all.second_moment += share * offset * offset * slope.first;
    }
  }
  all.force = in_node(all.force);
  all.stiffness = in_node(all.stiffness);
  all.valid = least_in_node(all.valid);
  if (TURNS) {
    all.couple = in_node(all.couple);
    all.first_moment = in_node(all.first_moment);
    all.second_moment = in_node(all.second_moment);
  }
  return all;
}

// Displacement of the tip under forces, by their compliance: each lane sums for one coordinate of its node
HERE Place displaced(const Model& model, const Place& free, const Forces& by) {
  synchronise();
  store(model.forces, (lane() & 7) + (group_of() >> 1) * NODES, where(in_upper(), by.tangential, by.radial),
        (lane() & 8) == 0);
  if (TURNS) store(model.forces, lane() + 16, by.couple, lane() < NODES);
  synchronise();
  real more = 0.0, more_too = 0.0;  // two sums at the same time
#pragma unroll
  for (int k = 0; k < OF_NODE; k += 2) {
    integer at = (group_of() & 1) * OF_NODE + k;
    more += model.response[k] * load(model.forces, at);
    more_too += model.response[k + 1] * load(model.forces, at + 1);
  }
  more += more_too;
  more += exchange(more, 8);
  real other = exchange(more, 16);
  Place place{free.radial + where(in_upper(), other, more), free.tangential + where(in_upper(), more, other),
              0.0, free.tilt};
  if (TURNS) {
    real turning = 0.0;
#pragma unroll
    for (int k = 0; k < OF_TILT; k++)
      turning += model.response[OF_NODE + k] * load(model.forces, group_of() * OF_TILT + k);
    place.tilt = free.tilt + in_node(turning);
  }
  return place;
}

// Find the contact forces that agree with the displacement they cause, as `bladerub.contact.kernel.newton`.
// `place` comes as the displacement without forces and leaves under them. Returns how the run goes on.
HERE int find_forces(const Model& model, State& state, double passed, real position_before, Place& place) {
  const Place free = place;
  Place there{free.radial + state.response.radial, free.tangential + state.response.tangential, 0.0,
              free.tilt + state.response.tilt};
  Place here;
  real approach = 0.0, tilt = there.tilt, reached = 0.0, normal_radial = 0.0, normal_tangential = 0.0,
       position = 0.0;
  real linear_approach = 0.0, linear_tilt = 0.0;
  Linearisation linear{0.0, 0.0, -1.0, 0.0, 0.0, 0.0};
  bool found = false, moved = true, first = true;
  for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
    if (moved) {  // where the nodes are on the casing
      if (!is_within_limit(model, there.radial, there.tangential)) return first ? UNBOUNDED : HANDED_OVER;
      here = there;
      real outward = model.node.radius + here.radial;
      here.approach = sqrt_of(outward * outward + here.tangential * here.tangential) - model.node.radius;
      real share = reciprocal(model.node.radius + here.approach);
      normal_radial = share * outward, normal_tangential = share * here.tangential;
      position = closest_position(model.node, here.tangential, passed);
      real behind = minimum(position, position_before);
      if (any(maximum(position, position_before) - behind > farthest(model.tip))) return HANDED_OVER;
      look(model, state.window, behind);
      if (first) approach = here.approach;
      first = moved = false;
      linear.valid = -1.0;
    }
    real change = absolute(approach - linear_approach);
    if (TURNS) change += edge(model.tip) * absolute(tilt - linear_tilt);
    if (!all(change <= linear.valid)) {
      linear = linearise(model, state.window, position, approach, tilt);
      linear_approach = approach, linear_tilt = tilt;
    }
    real closer = approach - linear_approach, turned = tilt - linear_tilt;
    Forces& force = state.force;
    force.normal = linear.force + linear.stiffness * closer;
    if (TURNS) {
      force.normal += linear.first_moment * turned;
      force.couple = model.normal_factor *
                     (linear.couple + linear.first_moment * closer + linear.second_moment * turned);
    }
    Pair split = contact_force(model.normal_factor, model.tangential_factor, normal_radial, normal_tangential,
                               force.normal);
    force.radial = split.first, force.tangential = split.second;
    there = displaced(model, free, force);
    real more_tangential = there.tangential - here.tangential;
    reached =
        here.approach + normal_radial * (there.radial - here.radial) + normal_tangential * more_tangential;
    real residual = approach - reached, tilt_residual = tilt - there.tilt, error = absolute(residual);
    if (TURNS) error += edge(model.tip) * absolute(tilt_residual);
    bool straight = all(absolute(more_tangential) <= STRAIGHT);
    if (straight && all(error <= TOLERANCE)) {
      found = true;
      break;
    }
    approach = approach - residual * reciprocal(1.0 + model.self_compliance * linear.stiffness);
    if (TURNS) tilt = tilt - tilt_residual * reciprocal(1.0 + model.tilt_compliance * linear.second_moment);
    moved = !straight;
  }
  if (!found) return HANDED_OVER;
  place = Place{there.radial, there.tangential, reached, there.tilt};
  state.response =
      Place{there.radial - free.radial, there.tangential - free.tangential, 0.0, there.tilt - free.tilt};
  return is_within_limit(model, there.radial, there.tangential) ? COMPLETED : UNBOUNDED;
}

// Wear the coating by the forces of a step, and enter energies and sliding, as `elements.update_wear` and
// `accounting.update_coating`. Returns how the run goes on.
HERE int update_coating(const Model& model, State& state, double passed, real position_before,
                        const Place& next) {
  const Place& now = state.now;
  const Profile& tip = model.tip;
  real position = closest_position(model.node, next.tangential, passed), advance = position - position_before;
  if (any(absolute(advance) > farthest(tip))) return HANDED_OVER;
  real slid = where(state.force.normal > 0.0, advance, model.per_step), retreat = model.per_step - slid;
  if (!all(slid > 0.0)) state.reversed++;
  look(model, state.window, minimum(position, position_before));
  real closer = next.approach - now.approach, constant = relief(tip, advance),
       slope = 2.0 * tip.curvature * advance;
  real per_advance = reciprocal(maximum(absolute(advance), NO_ADVANCE));
  real stored = 0.0, dissipated = 0.0, supplied = 0.0;
#pragma unroll
  for (int k = 0; k < ROWS; k++) {
    integer row = state.window.row + GROUPS * k;
    real offset = real_of(row) + 0.5 - position, worn = state.window.worn[k];
    real share = coverage(tip, offset), share_before = coverage(tip, offset + advance);
    real lowering = slope * offset + constant, here = next.approach, turning = closer;
    if (TURNS) {
      here += next.tilt * offset;
      turning += (next.tilt - now.tilt) * (offset + 0.5 * advance);
      lowering = lowering - 0.5 * (next.tilt + now.tilt) * advance;
    }
    real depth = penetration(here, relief(tip, offset), state.window.gap[k], worn),
         deeper = turning + lowering;
    Pair mapped = return_mapping(model.element, depth, worn);
    real force_before = elastic_force(model.element, depth - deeper, worn);
    flag under = share > 0.0, was_under = share_before > 0.0;
    real force = where(under, mapped.first, 0.0), increment = where(under, mapped.second, 0.0);
    state.window.worn[k] = worn + increment;
    store(model.wear, wrap(row, model.n_elements) * NODES + (lane() & 7), state.window.worn[k],
          increment > 0.0);
    real energy = stored_energy(model.element, force),
         energy_before = stored_energy(model.element, force_before);
    real loss = dissipated_energy(model.element, worn, increment, where(was_under, force_before, 0.0), force);
    stored += share * energy;
    dissipated += loss;
    flag stays = under & was_under, changes = absolute(deeper) > NO_CHANGE;
    real mean_force =
        where(changes, (energy - energy_before + loss) * reciprocal(where(changes, deeper, 1.0)), force);
    mean_force = where(stays, mean_force, where(under, force, force_before));
    real mean_share = mean_coverage(share, share_before, per_advance);
    real excess = where(stays, (share - share_before) * (force - force_before) / 12.0, 0.0);
    real by_blade = (mean_share * mean_force + excess) * turning;
    supplied += share * energy - share_before * energy_before + loss - by_blade;
  }
  synchronise();
  state.force.moment =
      (0.0 - model.tangential_factor) * state.force.normal * (model.node.lever + next.approach);
  set_entry(model, STORED_BEFORE, entry(model, STORED));
  set_entry(model, STORED, stored);
  set_entry(model, LAST_WEAR, dissipated);
  set_entry(model, LAST_SHAPE, supplied);
  add_entry(model, WEAR, dissipated);
  add_entry(model, SHAPE, supplied);
  real rest = entry(model, OF_REST);
  set_entry(model, OF_REST, by_group(rest + absolute(in_node(supplied)), maximum(rest, retreat), rest, rest));
  return COMPLETED;
}

// Add the work of the forces of the step before, over half of the path around it, as `accounting.add_work`
HERE void add_work(const Model& model, const State& state, const Place& next) {
  const Place &now = state.now, &before = state.before;
  const Forces& force = state.force_before;
  real more_radial = 0.5 * (next.radial - before.radial),
       more_tangential = 0.5 * (next.tangential - before.tangential);
  real by_radial = force.radial * more_radial, by_tangential = force.tangential * more_tangential;
  real sliding = 0.0, by_couple = 0.0;
  if (TURNS) {
    by_couple = force.couple * (0.5 * (next.tilt - before.tilt));
    if (model.tangential_factor != 0.0)
      sliding = 0.0 - (1.0 + model.normal_factor) / model.normal_factor * by_couple;
  }
  if (model.tangential_factor != 0.0) {
    real share = reciprocal(model.node.radius + now.approach);
    real normal_radial = share * (model.node.radius + now.radial), normal_tangential = share * now.tangential;
    real distance = model.angle * (model.node.lever + now.approach) + normal_radial * more_tangential -
                    normal_tangential * more_radial;
    real closer = normal_radial * more_radial + normal_tangential * more_tangential;
    real friction_force = (0.0 - model.tangential_factor) * force.normal;
    sliding += friction_force * distance - (1.0 + model.normal_factor) * force.normal * closer;
  }
  add_entry(model, OF_WORK, by_group(by_radial, by_tangential, sliding, force.moment));
  add_entry(model, OF_REST, by_group(absolute(by_radial) + absolute(by_tangential), 0.0, by_couple, 0.0));
}

// Contact at the end of a step, where the tip was in contact or is not clear. Returns how the run goes on.
HERE int contact(const Model& model, State& state, bool touched, bool clear, double passed, Place& next) {
  const real position_before = closest_position(model.node, state.now.tangential, passed - model.per_step);
  state.touching = false;
  if (clear) {
    state.force = Forces{0.0, 0.0, 0.0, 0.0, 0.0};
    state.response = Place{0.0, 0.0, 0.0, 0.0};
  } else {
    int status = find_forces(model, state, passed, position_before, next);
    if (status != COMPLETED) {
      state.force = touched ? state.force_before : Forces{0.0, 0.0, 0.0, 0.0, 0.0};
      return status;
    }
    state.touching = any(state.force.normal > 0.0);
  }
  if (state.touching || touched) {
    int status = update_coating(model, state, passed, position_before, next);
    if (status != COMPLETED) return status;
  }
  if (touched) add_work(model, state, next);
  return COMPLETED;
}

// Prepare what a run is, and what it is at the start
HERE void set_up(const Batch& batch, int run, double* shared, Model& model, State& state) {
  const int* of = batch.runs + RECORDS * run;
  const double* modal = batch.modal + (size_t)MODAL_SIZE * of[OF_MODAL];
  const double* stator = batch.stator + (size_t)STATOR_SIZE * of[OF_STATOR];
  const double* tip = batch.tip + (size_t)TIP_SIZE * of[OF_TIP];
  const integer j = lane() & 7;
  model.forces = shared;
  model.ledger = model.forces + 24;
  double* kept = model.ledger + LANES * KEPT;
  for (int i = 0; i < TIP_ROWS + SUMS * STRIDE; i += LANES)
    store(kept, lane() + i, load(modal, lane() + i), everywhere());
  for (int i = 0; i < KEPT; i++) set_entry(model, i, 0.0);
  model.coefficients = kept;
  model.tips = kept + TIP_ROWS;
  model.forms = modal + FORMS;
  model.n_elements = (int)batch.n_elements;
  model.wear = batch.wear + (size_t)NODES * batch.n_elements * run;
  model.gap = batch.casing + (size_t)(NODES + 1) * batch.n_elements * of[OF_CASING];
  model.node = Node{load(tip, j), load(tip, j + 8), load(tip, j + 16), load(tip, j + 24)};
  model.tip = Profile{tip[32], tip[33]};
  model.search_range = tip[34], model.limit = tip[35];
  model.element = load_element(stator, j);
  model.self_compliance = load(stator, j + SELF), model.tilt_compliance = load(stator, j + SELF + NODES);
  model.normal_factor = stator[FACTORS], model.tangential_factor = stator[FACTORS + 1];
  model.flight_steps = (int)modal[FLIGHT];
  model.sideways = modal[FLIGHT + 1], model.per_step = 1.0 / of[STEPS_PER_ELEMENT];
  model.angle = model.per_step * (2.0 * 3.14159265358979323846 / model.n_elements);
#pragma unroll
  for (int k = 0; k < OF_NODE + OF_TILT; k++) model.response[k] = load(modal + RESPONSE, lane() + LANES * k);
#pragma unroll
  for (int m = 0; m < MODES; m++) {
    state.q[m] = load(batch.modes + 2 * STRIDE * (size_t)run, lane() + LANES * m);
    state.d[m] = load(batch.modes + 2 * STRIDE * (size_t)run + STRIDE, lane() + LANES * m);
  }
  synchronise();
  state.damping = 0.0;
  state.now = state.before = project(model.tips, state.q, model.node);
  state.response = Place{0.0, 0.0, 0.0, 0.0};
  state.force = state.force_before = Forces{0.0, 0.0, 0.0, 0.0, 0.0};
  state.touching = false;
  state.reversed = 0;
}

// Leave the state of a run at its end
HERE void leave(const Batch& batch, int run, const Model& model, const State& state) {
#pragma unroll
  for (int m = 0; m < MODES; m++) {
    store(batch.modes + 2 * STRIDE * (size_t)run, lane() + LANES * m, state.q[m], everywhere());
    store(batch.modes + 2 * STRIDE * (size_t)run + STRIDE, lane() + LANES * m, state.d[m], everywhere());
  }
  double* forces = batch.forces + 48 * (size_t)run;
  const flag first_group = lane() < NODES;
  store(forces, lane(), state.force.radial, first_group);
  store(forces, lane() + 8, state.force.tangential, first_group);
  store(forces, lane() + 16, state.force.couple, first_group);
  store(forces, lane() + 24, state.force_before.radial, first_group);
  store(forces, lane() + 32, state.force_before.tangential, first_group);
  store(forces, lane() + 40, state.force_before.couple, first_group);
  double* entries = batch.ledger + LANES * (KEPT + 1) * (size_t)run;
  for (int i = 0; i < KEPT; i++) store(entries, lane() + LANES * i, entry(model, i), everywhere());
  store(entries, lane() + LANES * KEPT, state.damping, everywhere());
}

HERE void simulate(const Batch& batch, int run, double* shared) {
  const int n = (int)batch.n_elements, n_revolutions = (int)batch.revolutions;
  const int steps_per_element = batch.runs[RECORDS * run + STEPS_PER_ELEMENT];
  Model model;
  State state;
  set_up(batch, run, shared, model, state);
  const double* minimum_gaps = model.gap + NODES * n;
  const flag first_lane = lane() == 0;
  real far = 0.0;
  int status = COMPLETED, revolution = 0, n_contact = 0;
  int steps = 0, steps_before = 0;

  for (; revolution < n_revolutions && status == COMPLETED; revolution++) {
    bool touched = state.touching, flew = false;
    real bottom = INFINITY, top = -INFINITY;
    state.window.row = NO_ROW;
    steps_before = steps;
    for (int element = 0; element < n && status == COMPLETED; element++) {
      const double minimum_gap = minimum_gaps[element];
      real mean = 0.0;
      int step = 0;
      while (step < steps_per_element && status == COMPLETED) {
        if (state.touching || step + model.flight_steps > steps_per_element)
          flew = false;
        else {
          if (!flew) far = bound(model, state);
          flew = is_clear(model, state.now, far, minimum_gap);
        }
        if (flew) {
          touched = false;
          fly(model, state, far, mean, bottom, top);
          step += model.flight_steps;
          steps += model.flight_steps;
          continue;
        }
        int together =
            model.flight_steps < steps_per_element - step ? model.flight_steps : steps_per_element - step;
        for (int i = 0; i < together && status == COMPLETED; i++) {
          touched = state.touching;
          if (touched) state.force_before = state.force;
          real x[MODES], there[MODES];
          advance(model, state, touched, x);
#pragma unroll
          for (int m = 0; m < MODES; m++) there[m] = state.q[m] + x[m];
          Place next = project(model.tips, there, model.node);
          step++;
          bool clear = is_clear(model, next, 0.0, minimum_gap);
          if (touched || !clear) {
            status = contact(model, state, touched, clear, element + step * model.per_step, next);
            if (status != COMPLETED) break;
            n_contact += state.touching;
          }
#pragma unroll
          for (int m = 0; m < MODES; m++) {
            real both = x[m] + state.d[m];
            state.damping += load(model.coefficients + 2 * STRIDE, lane() + LANES * m) * both * both;
            state.d[m] = x[m];
            state.q[m] = there[m];
          }
          mean += 0.5 * (state.now.radial + next.radial);
          bottom = minimum(bottom, next.radial);
          top = maximum(top, next.radial);
          steps++;
          state.before = state.now;
          state.now = next;
        }
      }
      if (status == COMPLETED)
        store(batch.displacement + (size_t)run * n_revolutions * n, lane() + (revolution * n + element),
              mean * model.per_step, first_lane);
    }
    store(batch.range + (size_t)run * n_revolutions * 2, lane() + 2 * revolution, bottom, first_lane);
    store(batch.range + (size_t)run * n_revolutions * 2, lane() + (2 * revolution + 1), top, first_lane);
    if (status == COMPLETED && !(touched || state.touching)) {  // the last step added nothing
      for (int i = STORED; i < KEPT; i++) set_entry(model, i, 0.0);
    }
  }
  leave(batch, run, model, state);
  long long* counts = batch.counts + COUNTS * (size_t)run;
  counts[STATUS] = status;
  counts[REVOLUTIONS] = status == COMPLETED ? revolution : revolution - 1;
  counts[STEPS] = steps;
  counts[LAST_STEPS] = steps - steps_before;
  counts[CONTACT_STEPS] = n_contact;
  counts[REVERSED_STEPS] = state.reversed;
}

// `order` (n_runs, 2) has piece and number of each run
#define ARGUMENTS int n_runs, const int *order, int *next, const Batch *batches

#ifdef __CUDACC__
extern "C" __global__ void __launch_bounds__(LANES, WARPS_PER_PROCESSOR) simulate_batches(ARGUMENTS) {
  extern __shared__ double shared[];
  for (;;) {  // each warp takes the next run until none is left
    int place = 0;
    if (threadIdx.x == 0) place = atomicAdd(next, 1);
    place = __shfl_sync(ALL_THREADS, place, 0);
    if (place >= n_runs) return;
    simulate(batches[order[2 * place]], order[2 * place + 1], shared);
    __syncwarp();
  }
}
#else
extern "C" void simulate_batches(ARGUMENTS) {
  double shared[SHARED];
  for (; *next < n_runs; ++*next) simulate(batches[order[2 * *next]], order[2 * *next + 1], shared);
}
#endif
