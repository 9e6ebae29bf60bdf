// The time loop of single runs, a warp a run, by the contract of `bladerub.contact.schemes`.
//
// It makes the steps of `bladerub.contact.kernel` for a scheme that does not correct, deformable elements and a
// force of constant direction; a run that it can't go on with is HANDED_OVER. Its functions are named as
// those there. The formulas of law, profile and contact force are not written here: they are translated from
// Python (`bladerub.contact.gpu.formulas`) and stand before this text, with the constants in capitals.
//
// A lane is node j = lane % 8 in group = lane / 8 and holds the modes lane, lane + 32, ... The groups share the
// rows of elements under a node: of its window, a group has each fourth row.

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

struct Batch {
  int n_elements, revolutions;
  const double *modal, *stator, *casing, *tip;  // records, one after the other
  const int* runs;       // (n, RECORDS): numbers of the records of each run, and its steps in an element
  double* modes;         // (n, 2, STRIDE): modal coordinates and their last increment, at the start and the end
  double* wear;          // (n, N, 8), m; 0 at the start
  double* displacement;  // (n, revolutions N): of node 1, mean over each element, m
  double* range;         // (n, revolutions, 2): of that displacement, m
  double* forces;        // (n, 2, 24): on the blade now and one step before
  double* ledger;        // (n, KEPT + 1, 32): its rows, and the damping loss
  long long* counts;     // (n, COUNTS)
};
struct Node { real start, per_metre, radius, lever; };
struct Place { real radial, tangential, approach, tilt; };
// Of the elements under a node, those of the group: rows `row`, `row` + 4, ...
struct Window { integer row; real gap[ROWS], worn[ROWS]; };
struct Linearisation { real force, stiffness, valid, couple, first_moment, second_moment; };

HERE real in_node(real a) { a += exchange(a, 8); return a + exchange(a, 16); }  // sum of the groups
HERE real least_in_node(real a) { a = minimum(a, exchange(a, 8)); return minimum(a, exchange(a, 16)); }
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

HERE void look(Window& window, real position, const Profile& tip, const double* wear, const double* gap, int n) {
  integer first = floor_of(position - tip.half_width);
  integer row = first + (((lane() >> 3) - first) & 3);
  if (any(row != window.row)) {
    window.row = row;
#pragma unroll
    for (int k = 0; k < ROWS; k++) {
      integer at = wrap(row + GROUPS * k, n) * NODES + (lane() & 7);
      window.gap[k] = load(gap, at);
      window.worn[k] = load(wear, at);
    }
  }
}

HERE Linearisation linearise(const Element& element, const Profile& tip, const Window& window, real position, real approach, real tilt) {
  Linearisation all{0.0, 0.0, INFINITY, 0.0, 0.0, 0.0};
#pragma unroll
  for (int k = 0; k < ROWS; k++) {
    real offset = real_of(window.row + GROUPS * k) + 0.5 - position, share = coverage(tip, offset);
    real here = TURNS ? approach + tilt * offset : approach;
    real depth = penetration(here, relief(tip, offset), window.gap[k], window.worn[k]);
    real force = return_mapping(element, depth, window.worn[k]).first;
    Pair slope = tangent(element, depth, window.worn[k]);
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

// Forces of the nodes to where all lanes read them
HERE void publish(double* forces, real radial, real tangential, real couple) {
  synchronise();
  flag upper = lane() >= 16;
  store(forces, (lane() & 7) + ((lane() >> 4) & 1) * NODES, where(upper, tangential, radial), (lane() & 8) == 0);
  if (TURNS) store(forces, lane() + 16, couple, lane() < NODES);
  synchronise();
}

HERE void simulate(const Batch& batch, int run, double* shared) {
  double* forces = shared;
  double* ledger = forces + 24;
  double* coefficients = ledger + LANES * KEPT;
  double* tips = coefficients + 4 * STRIDE;
  const int n = batch.n_elements;
  const int* of = batch.runs + RECORDS * run;
  const double* modal = batch.modal + (size_t)MODAL_SIZE * of[OF_MODAL];
  const double* stator = batch.stator + (size_t)STATOR_SIZE * of[OF_STATOR];
  const double* gap = batch.casing + (size_t)(NODES + 1) * n * of[OF_CASING];
  const double* minimum_gaps = gap + NODES * n;
  const double* at_tip = batch.tip + (size_t)TIP_SIZE * of[OF_TIP];
  const int steps_per_element = of[STEPS_PER_ELEMENT];
  double* wear = batch.wear + (size_t)NODES * n * run;
  const integer j = lane() & 7, mask = j + ((lane() >> 4) & 1) * NODES;
  const flag upper = lane() >= 16, odd = (lane() & 8) != 0, first_group = lane() < NODES, every = lane() >= 0, first_lane = lane() == 0;

  for (int i = 0; i < TIP_ROWS + SUMS * STRIDE; i += LANES) store(coefficients, lane() + i, load(modal, lane() + i), every);
  for (int i = 0; i < LANES * KEPT; i += LANES) store(ledger, lane() + i, 0.0, every);
  const Node node{load(at_tip, j), load(at_tip, j + 8), load(at_tip, j + 16), load(at_tip, j + 24)};
  const Profile tip{at_tip[32], at_tip[33]};
  const double search_range = at_tip[34], limit = at_tip[35];
  const Element element = load_element(stator, j);
  const real own = load(stator, j + SELF), own_tilt = load(stator, j + SELF + NODES);
  const double normal_factor = stator[FACTORS], tangential_factor = stator[FACTORS + 1];
  const double* forms = modal + FORMS;
  const int flight_steps = (int)modal[FLIGHT];
  const double sideways = modal[FLIGHT + 1], per_step = 1.0 / steps_per_element;
  const double angle = per_step * (2.0 * 3.14159265358979323846 / n);
  real response[OF_NODE + OF_TILT];
#pragma unroll
  for (int k = 0; k < OF_NODE + OF_TILT; k++) response[k] = load(modal + RESPONSE, lane() + LANES * k);
  real q[MODES], d[MODES];
#pragma unroll
  for (int m = 0; m < MODES; m++) {
    q[m] = load(batch.modes + 2 * STRIDE * (size_t)run, lane() + LANES * m);
    d[m] = load(batch.modes + 2 * STRIDE * (size_t)run + STRIDE, lane() + LANES * m);
  }
  synchronise();
#define ENTRY(i) (ledger + LANES * (i))
#define GET(i) load(ENTRY(i), lane())
#define SET(i, value) store(ENTRY(i), lane(), value, every)
#define ADD(i, value) SET(i, GET(i) + (value))
#define BY_GROUP(a, b, c, d) where(upper, where(odd, d, c), where(odd, b, a))

  Place now = project(tips, q, node), before = now;
  real by_radial = 0.0, by_tangential = 0.0, by_couple = 0.0, normal_force = 0.0, moment = 0.0;
  real radial_before = 0.0, tangential_before = 0.0, couple_before = 0.0, normal_before = 0.0, moment_before = 0.0;
  Place answer{0.0, 0.0, 0.0, 0.0};  // displacement by the forces of the last step in that step
  real damping = 0.0, far = 0.0;
  Window window;
  bool touching = false;
  int status = COMPLETED, revolution = 0, reversed = 0, contact = 0;
  long long steps = 0, steps_before = 0;

  for (; revolution < batch.revolutions && status == COMPLETED; revolution++) {
    bool touched = touching, flew = false;
    real bottom = INFINITY, top = -INFINITY;
    window.row = NO_ROW;
    steps_before = steps;
    for (int passing = 0; passing < n && status == COMPLETED; passing++) {
      const double minimum_gap = minimum_gaps[passing];
      real mean = 0.0;
      int step = 0;
      while (step < steps_per_element && status == COMPLETED) {
        if (touching || step + flight_steps > steps_per_element) flew = false;
        else {
          if (!flew) {
            far = 0.0;
#pragma unroll
            for (int m = 0; m < MODES; m++) {
              far += load(forms + BOUND_Q * MODES, lane() + LANES * m) * absolute(q[m]);
              far += load(forms + BOUND_D * MODES, lane() + LANES * m) * absolute(d[m]);
            }
            far = total(far);
          }
          real closest = now.approach + far;
          if (TURNS) closest = closest + highest(tip, absolute(now.tilt));
          flew = all((closest <= minimum_gap) & (absolute(now.tangential) + sideways * far <= search_range) & (now.radial - far > -limit));
        }
        if (flew) {  // many steps at once
          touched = false;
          real start = now.radial, increment_1 = 0.0;
          far = 0.0;
#pragma unroll
          for (int m = 0; m < MODES; m++) {
#define FORM(i) load(forms + (i) * MODES, lane() + LANES * m)
            real present = q[m], last = d[m];
            damping += (FORM(LOSS_QQ) * present + FORM(LOSS_QD) * last) * present + FORM(LOSS_DD) * last * last;
            increment_1 += FORM(MEAN_Q) * present + FORM(MEAN_D) * last;
            q[m] = present + (FORM(INCREMENT_Q) * present + FORM(INCREMENT_D) * last);
            d[m] = FORM(LAST_STEP_Q) * present + FORM(LAST_STEP_D) * last;
            far += FORM(BOUND_Q) * absolute(q[m]) + FORM(BOUND_D) * absolute(d[m]);
#undef FORM
          }
          real mine = where(upper, far, increment_1) + exchange(where(upper, increment_1, far), 16);  // two sums
          for (int bit = 8; bit; bit >>= 1) mine += exchange(mine, bit);
          real other = exchange(mine, 16);
          far = where(upper, mine, other);
          increment_1 = where(upper, other, mine);
          now = project(tips, q, node);
          mean += flight_steps * (start + increment_1);
          real end = now.radial, middle = 0.5 * (start + end), bulge = start + increment_1 - middle;
          flag turns = absolute(end - start) < 6.0 * absolute(bulge);
          real vertex = middle + 1.5 * bulge + (end - start) * (end - start) / (24.0 * where(turns, bulge, 1.0));
          vertex = where(turns, vertex, end);
          bottom = minimum(bottom, minimum(minimum(start, end), vertex));
          top = maximum(top, maximum(maximum(start, end), vertex));
          step += flight_steps;
          steps += flight_steps;
          continue;
        }
        int together = flight_steps < steps_per_element - step ? flight_steps : steps_per_element - step;
        for (int i = 0; i < together && status == COMPLETED; i++) {
          touched = touching;
          real x[MODES], there[MODES];
#pragma unroll
          for (int m = 0; m < MODES; m++) {
            x[m] = load(coefficients, lane() + LANES * m) * q[m] + load(coefficients + STRIDE, lane() + LANES * m) * d[m];
          }
          if (touched) {  // under the forces of the step before
            radial_before = by_radial, tangential_before = by_tangential, couple_before = by_couple;
            normal_before = normal_force, moment_before = moment;
            real g[MODES];
#pragma unroll
            for (int m = 0; m < MODES; m++) g[m] = 0.0;
#pragma unroll
            for (int s = 0; s < SUMS; s++) {
              real by = load(forces, s < 16 ? mask ^ s : (j ^ (s - 16)) + 16);
#pragma unroll
              for (int m = 0; m < MODES; m++) g[m] += load(tips, lane() + LANES * (SUMS * m + s)) * by;
            }
#pragma unroll
            for (int m = 0; m < MODES; m++) x[m] += load(coefficients + 3 * STRIDE, lane() + LANES * m) * g[m];
          }
#pragma unroll
          for (int m = 0; m < MODES; m++) there[m] = q[m] + x[m];
          Place next = project(tips, there, node);
          step++;
          real closest = next.approach;
          bool clear = all((closest <= minimum_gap) & (absolute(next.tangential) <= search_range) & (next.radial > -limit));
          if (TURNS && clear) clear = all(closest + highest(tip, absolute(next.tilt)) <= minimum_gap);
          if (touched || !clear) {
            const double passed = passing + step * per_step;
            const real position_before = closest_position(node, now.tangential, passed - per_step);
            touching = false;
            if (clear) {
              by_radial = by_tangential = by_couple = normal_force = 0.0;
              answer = Place{0.0, 0.0, 0.0, 0.0};
            } else {  // Newton's method, as `bladerub.contact.kernel.newton`
              const Place free = next;
              real radial = free.radial + answer.radial, tangential = free.tangential + answer.tangential;
              real tilt = free.tilt + answer.tilt, reached_tilt = tilt;
              Place here;
              real approach = 0.0, reached = 0.0, normal_radial = 0.0, normal_tangential = 0.0, position = 0.0;
              real linear_approach = 0.0, linear_tilt = 0.0;
              Linearisation linear{0.0, 0.0, -1.0, 0.0, 0.0, 0.0};
              bool found = false, moved = true, first = true;
              for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
                if (moved) {  // where the nodes are on the casing
                  if (!all((absolute(radial) <= limit) & (absolute(tangential) <= limit))) break;
                  real outward = node.radius + radial;
                  here = Place{radial, tangential, sqrt_of(outward * outward + tangential * tangential) - node.radius, 0.0};
                  real share = reciprocal(node.radius + here.approach);
                  normal_radial = share * outward, normal_tangential = share * tangential;
                  position = closest_position(node, tangential, passed);
                  if (any(maximum(position, position_before) - minimum(position, position_before) > FARTHEST)) break;
                  look(window, minimum(position, position_before), tip, wear, gap, n);
                  if (first) approach = reached = here.approach;
                  first = moved = false;
                  linear.valid = -1.0;
                }
                real change = absolute(approach - linear_approach);
                if (TURNS) change += edge(tip) * absolute(tilt - linear_tilt);
                if (!all(change <= linear.valid)) {
                  linear = linearise(element, tip, window, position, approach, tilt);
                  linear_approach = approach, linear_tilt = tilt;
                }
                real closer = approach - linear_approach, turned = tilt - linear_tilt;
                normal_force = linear.force + linear.stiffness * closer;
                if (TURNS) {
                  normal_force += linear.first_moment * turned;
                  by_couple = normal_factor * (linear.couple + linear.first_moment * closer + linear.second_moment * turned);
                }
                Pair force = contact_force(normal_factor, tangential_factor, normal_radial, normal_tangential, normal_force);
                by_radial = force.first, by_tangential = force.second;
                publish(forces, by_radial, by_tangential, by_couple);
                real more = 0.0, more_too = 0.0;
#pragma unroll
                for (int k = 0; k < OF_NODE; k += 2) {
                  integer at = ((lane() >> 3) & 1) * OF_NODE + k;
                  more += response[k] * load(forces, at);
                  more_too += response[k + 1] * load(forces, at + 1);
                }
                more += more_too;
                more += exchange(more, 8);
                real other = exchange(more, 16);
                radial = free.radial + where(upper, other, more);
                tangential = free.tangential + where(upper, more, other);
                if (TURNS) {
                  real turning = 0.0;
#pragma unroll
                  for (int k = 0; k < OF_TILT; k++) turning += response[OF_NODE + k] * load(forces, (lane() >> 3) * OF_TILT + k);
                  reached_tilt = free.tilt + in_node(turning);
                }
                real more_tangential = tangential - here.tangential;
                reached = here.approach + normal_radial * (radial - here.radial) + normal_tangential * more_tangential;
                real residual = approach - reached, tilt_residual = tilt - reached_tilt, error = absolute(residual);
                if (TURNS) error += edge(tip) * absolute(tilt_residual);
                bool straight = all(absolute(more_tangential) <= STRAIGHT);
                if (straight && all(error <= TOLERANCE)) {
                  found = true;
                  break;
                }
                approach = approach - residual * reciprocal(1.0 + own * linear.stiffness);
                if (TURNS) tilt = tilt - tilt_residual * reciprocal(1.0 + own_tilt * linear.second_moment);
                moved = !straight;
              }
              if (!found) {
                bool outside = !all((absolute(radial) <= limit) & (absolute(tangential) <= limit));
                status = outside && first ? UNBOUNDED : HANDED_OVER;
              } else if (!all((absolute(radial) <= limit) & (absolute(tangential) <= limit))) {
                status = UNBOUNDED;
              }
              if (status != COMPLETED) {
                by_radial = touched ? radial_before : 0.0, by_tangential = touched ? tangential_before : 0.0;
                by_couple = touched ? couple_before : 0.0;
                break;
              }
              next = Place{radial, tangential, reached, reached_tilt};
              answer = Place{radial - free.radial, tangential - free.tangential, 0.0, reached_tilt - free.tilt};
              touching = any(normal_force > 0.0);
            }
            if (touching || touched) {  // wear the coating, as `elements.update_wear`
              real position = closest_position(node, next.tangential, passed), advance = position - position_before;
              real slid = where(normal_force > 0.0, advance, per_step);
              real retreat = per_step - slid;
              if (!all(slid > 0.0)) reversed++;
              if (any(absolute(advance) > FARTHEST)) {
                status = HANDED_OVER;
                break;
              }
              look(window, minimum(position, position_before), tip, wear, gap, n);
              real closer = next.approach - now.approach, constant = relief(tip, advance), slope = 2.0 * tip.curvature * advance;
              real stored = 0.0, dissipated = 0.0, supplied = 0.0;
#pragma unroll
              for (int k = 0; k < ROWS; k++) {
                integer row = window.row + GROUPS * k;
                real offset = real_of(row) + 0.5 - position, worn = window.worn[k];
                real share = coverage(tip, offset), share_before = coverage(tip, offset + advance);
                real lowering = slope * offset + constant, here = next.approach, turning = closer;
                if (TURNS) {
                  here += next.tilt * offset;
                  turning += (next.tilt - now.tilt) * (offset + 0.5 * advance);
                  lowering = lowering - 0.5 * (next.tilt + now.tilt) * advance;
                }
                real depth = penetration(here, relief(tip, offset), window.gap[k], worn), deeper = turning + lowering;
                Pair mapped = return_mapping(element, depth, worn);
                real force_before = elastic_force(element, depth - deeper);
                flag under = share > 0.0, was_under = share_before > 0.0;
                real force = where(under, mapped.first, 0.0), increment = where(under, mapped.second, 0.0);
                window.worn[k] = worn + increment;
                store(wear, wrap(row, n) * NODES + j, window.worn[k], increment > 0.0);
                real energy = stored_energy(element, force), energy_before = stored_energy(element, force_before);
                real loss = dissipated_energy(element, worn, increment, where(was_under, force_before, 0.0), force);
                stored += share * energy;
                dissipated += loss;
                real mean_share = 0.5 * (share + share_before);
                flag changes = absolute(deeper) > NO_CHANGE;
                real mean_force = where(changes, (energy - energy_before + loss) * reciprocal(where(changes, deeper, 1.0)), force);
                real staying = mean_share * mean_force * lowering + 0.5 * (energy + energy_before) * (share - share_before) + (1.0 - mean_share) * loss;
                real entering = share * energy + loss, leaving = 0.0 - share_before * energy_before;
                supplied += where(under, where(was_under, staying, entering), leaving);
              }
              synchronise();
              moment = (0.0 - tangential_factor) * normal_force * (node.lever + next.approach);
              SET(STORED_BEFORE, GET(STORED));
              SET(STORED, stored);
              SET(LAST_WEAR, dissipated);
              SET(LAST_SHAPE, supplied);
              ADD(WEAR, dissipated);
              ADD(SHAPE, supplied);
              real rest = GET(OF_REST);
              SET(OF_REST, BY_GROUP(rest + absolute(in_node(supplied)), maximum(rest, retreat), rest, rest));
            }
            if (touched) {  // work of the forces of the step before, as `accounting.add_work`
              real more_radial = 0.5 * (next.radial - before.radial), more_tangential = 0.5 * (next.tangential - before.tangential);
              real work_radial = radial_before * more_radial, work_tangential = tangential_before * more_tangential;
              real sliding = 0.0, work_couple = 0.0;
              if (TURNS) {
                work_couple = couple_before * (0.5 * (next.tilt - before.tilt));
                if (tangential_factor != 0.0) sliding = 0.0 - (1.0 + normal_factor) / normal_factor * work_couple;
              }
              if (tangential_factor != 0.0) {
                real share = reciprocal(node.radius + now.approach);
                real normal_radial = share * (node.radius + now.radial), normal_tangential = share * now.tangential;
                real distance = angle * (node.lever + now.approach) + normal_radial * more_tangential - normal_tangential * more_radial;
                real closer = normal_radial * more_radial + normal_tangential * more_tangential;
                real friction_force = (0.0 - tangential_factor) * normal_before;
                sliding += friction_force * distance - (1.0 + normal_factor) * normal_before * closer;
              }
              ADD(OF_WORK, BY_GROUP(work_radial, work_tangential, sliding, moment_before));
              ADD(OF_REST, BY_GROUP(absolute(work_radial) + absolute(work_tangential), real(0.0), work_couple, real(0.0)));
            }
            contact += touching;
          }
#pragma unroll
          for (int m = 0; m < MODES; m++) {
            real both = x[m] + d[m];
            damping += load(coefficients + 2 * STRIDE, lane() + LANES * m) * both * both;
            d[m] = x[m];
            q[m] = there[m];
          }
          mean += 0.5 * (now.radial + next.radial);
          bottom = minimum(bottom, next.radial);
          top = maximum(top, next.radial);
          steps++;
          before = now;
          now = next;
        }
      }
      if (status == COMPLETED) store(batch.displacement + (size_t)run * batch.revolutions * n, lane() + (revolution * n + passing), mean * per_step, first_lane);
    }
    store(batch.range + (size_t)run * batch.revolutions * 2, lane() + 2 * revolution, bottom, first_lane);
    store(batch.range + (size_t)run * batch.revolutions * 2, lane() + (2 * revolution + 1), top, first_lane);
    if (status == COMPLETED && !(touched || touching)) {  // the last step added nothing
      SET(STORED, 0.0);
      SET(STORED_BEFORE, 0.0);
      SET(LAST_SHAPE, 0.0);
      SET(LAST_WEAR, 0.0);
    }
  }
#pragma unroll
  for (int m = 0; m < MODES; m++) {
    store(batch.modes + 2 * STRIDE * (size_t)run, lane() + LANES * m, q[m], every);
    store(batch.modes + 2 * STRIDE * (size_t)run + STRIDE, lane() + LANES * m, d[m], every);
  }
  double* left = batch.forces + 48 * (size_t)run;
  store(left, lane(), by_radial, first_group);
  store(left, lane() + 8, by_tangential, first_group);
  store(left, lane() + 16, by_couple, first_group);
  store(left, lane() + 24, radial_before, first_group);
  store(left, lane() + 32, tangential_before, first_group);
  store(left, lane() + 40, couple_before, first_group);
  double* entries = batch.ledger + LANES * (KEPT + 1) * (size_t)run;
  for (int i = 0; i < KEPT; i++) store(entries, lane() + LANES * i, GET(i), every);
  store(entries, lane() + LANES * KEPT, damping, every);
  long long* counts = batch.counts + COUNTS * (size_t)run;
  counts[STATUS] = status;
  counts[REVOLUTIONS] = status == COMPLETED ? revolution : revolution - 1;
  counts[STEPS] = steps;
  counts[LAST_STEPS] = steps - steps_before;
  counts[CONTACT_STEPS] = contact;
  counts[REVERSED_STEPS] = reversed;
}

#define ARGUMENTS \
  int n_runs, const int *order, int *next, int n_elements, int revolutions, const double *modal, const double *stator, \
  const double *casing, const double *tip, const int *runs, double *modes, double *wear, double *displacement, \
  double *range, double *forces, double *ledger, long long *counts
#define BATCH {n_elements, revolutions, modal, stator, casing, tip, runs, modes, wear, displacement, range, forces, ledger, counts}

#ifdef __CUDACC__
extern "C" __global__ void __launch_bounds__(LANES, WARPS_PER_PROCESSOR) simulate_batch(ARGUMENTS) {
  extern __shared__ double shared[];
  const Batch batch BATCH;
  for (;;) {  // each warp takes the next run until none is left
    int place = 0;
    if (threadIdx.x == 0) place = atomicAdd(next, 1);
    place = __shfl_sync(ALL_THREADS, place, 0);
    if (place >= n_runs) return;
    simulate(batch, order[place], shared);
    __syncwarp();
  }
}
#else
extern "C" void simulate_batch(ARGUMENTS) {
  const Batch batch BATCH;
  double shared[SHARED];
  for (; *next < n_runs; ++*next) simulate(batch, order[*next], shared);
}
#endif
