! SPDX-License-Identifier: BSD-3-Clause
! Box trees and interaction lists.
module trees_test
    use support
    implicit none
    integer, parameter :: n_line = 8

contains

    !> Points at the middles of the eighths of [0, 1], a leaf each: box i of level l is 2^l - 1 + i.
    subroutine make_line(context, tree)
        type(conn_context), intent(inout) :: context
        type(conn_tree), intent(inout) :: tree
        type(conn_tree_options) :: options
        real(c_double), target :: x(n_line)
        integer :: i
        x = [((i - 0.5_c_double)/n_line, i=1, n_line)]
        options%max_particles_in_box = 1
        options%bounding_box = 1
        options%box_hi(1) = 1
        call expect_ok(conn_context_create(context), 'context')
        call expect_ok(conn_tree_create(context, tree), 'tree')
        call expect_ok(conn_tree_build(tree, 1, [conn_array_vector(x)], options), 'build')
    end subroutine make_line

    subroutine a_line_of_points_has_the_boxes_and_lists_of_the_definitions()
        type(conn_context) :: context
        type(conn_tree) :: tree
        type(conn_lists) :: lists
        type(conn_tree_view) :: boxes
        type(conn_box_list_view) :: list
        type(conn_classes_view) :: classes
        integer(c_int32_t), pointer :: level_starts(:), parents(:), children(:, :), entries(:)
        integer(c_int32_t), pointer :: rows(:), class_of(:), ids(:)
        integer(c_int64_t), pointer :: starts(:)
        integer(c_int8_t), pointer :: levels(:), flags(:)
        real(c_double), pointer :: centers(:, :), x(:, :), radii(:), vectors(:, :), angles(:)
        integer(c_int64_t) :: n, total, counts(15)
        character(:), allocatable :: text
        integer :: i
        call make_line(context, tree)
        call expect_ok(conn_acquire(tree, boxes), 'boxes')
        call conn_tree_box_pointers(boxes, level_starts, parents, children, centers, levels, flags)
        call expect(boxes%n_boxes == 15 .and. all(level_starts == [0, 1, 3, 7, 15]), 'levels')
        call expect(lbound(parents, 1) == 0 .and. size(parents) == 15, 'extents')
        call expect(all(parents(1:14) == [((i - 1)/2, i=1, 14)]), 'parents')
        call expect(all(children(2, :) == [5, 6]) .and. children(7, 0) == 0, 'children')
        call expect(centers(0, 1) == 0.5_c_double .and. centers(14, 1) == 0.9375_c_double, 'places')
        call expect(levels(14) == 3 .and. flags(14) == 3 .and. flags(0) == 12, 'flags')
        call conn_tree_source_pointers(boxes, x, radii, ids)
        call expect(all(shape(x) == [8, 1]) .and. size(radii) == 0 .and. &
                    all(ids == [(i, i=0, 7)]) .and. x(7, 1) == centers(14, 1), 'sources')

        call expect_ok(conn_lists_create(context, lists), 'lists')
        call expect_error(conn_acquire(lists, CONN_LIST_TARGET_BOXES, list), CONN_E_NOT_BUILT, &
                          'conn_lists_rebuild', 'lists before a build')
        call expect_ok(conn_lists_rebuild(lists, tree), 'rebuild')
        call expect_ok(conn_acquire(lists, CONN_LIST_FROM_SEP_SIBLINGS, list), 'list 2')
        call conn_box_list_pointers(list, starts, entries, rows)
        call expect(lbound(starts, 1) == 0 .and. size(starts) == 16 .and. rows(9) == 9, 'rows')
        call expect(all(entries(starts(9):starts(10) - 1) == [7, 11, 12]), 'row of box 9')
        call expect(list%generation == boxes%generation, 'generation')
        call expect_ok(conn_acquire(lists, CONN_CLASSES_TRANSLATION, classes), 'classes')
        call conn_classes_pointers(classes, class_of, level_starts, vectors, angles)
        call expect(all(level_starts == [0, 4]) .and. size(angles) == 0 .and. &
                    vectors(class_of(starts(9)), 1) == 2, 'from box 7 to box 9')
        call expect_ok(conn_lists_work(lists, CONN_WORK_M2L, n, total, counts), 'work')
        call expect(n == 15 .and. total == size(entries) .and. counts(10) == 3, 'm2l')
        call expect_error(conn_lists_work(lists, CONN_WORK_M2L, n, total, counts(:3)), &
                          CONN_E_BUFFER, '15', 'too small')
        call expect_ok(conn_release(list), 'release')
        call expect_ok(conn_release(classes), 'release')
        call expect_ok(conn_acquire(lists, CONN_LIST_FROM_SEP_CLOSE_BIGGER, list), 'none')
        call conn_box_list_pointers(list, starts, entries)
        call expect(list%is_none == 1 .and. size(entries) == 0 .and. size(starts) == 0, 'is none')
        call expect_ok(conn_release(list), 'release')
        call expect_ok(conn_lists_merge_close(lists), 'merge')
        call expect_ok(conn_lists_report_text(lists, text), 'report')
        call expect(index(text, 'from_sep_siblings') > 0, 'the report names lists')
        call expect_ok(conn_release(boxes), 'release')
        call expect_ok(conn_destroy(lists), 'destroy')
        call expect_ok(conn_destroy(tree), 'destroy')
        call expect_ok(conn_destroy(context), 'destroy')
    end subroutine a_line_of_points_has_the_boxes_and_lists_of_the_definitions

    !> Meetings of a list: met(target, source), in the order of the host.
    subroutine meet(lists, boxes, which, level, targets_below, sources_below, met)
        type(conn_lists), intent(in) :: lists
        type(conn_tree_view), intent(in) :: boxes
        integer(c_int32_t), intent(in) :: which, level
        logical, intent(in) :: targets_below, sources_below
        integer, intent(inout) :: met(0:, 0:)
        type(conn_box_list_view) :: list
        integer(c_int64_t), pointer :: starts(:)
        integer(c_int32_t), pointer :: entries(:), rows(:), user(:), order(:)
        integer(c_int32_t), pointer :: s_start(:), s_own(:), s_all(:), t_start(:), t_own(:), t_all(:)
        integer :: user_target(0:size(met, 1) - 1), t, s, a, k, n_t, n_s
        integer(c_int64_t) :: r, e
        call conn_tree_source_pointers(boxes, user_ids=user, starts=s_start, &
                                       counts_nonchild=s_own, counts_cumul=s_all)
        call conn_tree_target_pointers(boxes, sorted_ids=order, starts=t_start, &
                                       counts_nonchild=t_own, counts_cumul=t_all)
        do k = 0, size(order) - 1
            user_target(order(k)) = k
        end do
        call expect_ok(conn_acquire(lists, which, list, level), 'a list')
        call conn_box_list_pointers(list, starts, entries, rows)
        do r = 0, list%n_rows - 1
            t = rows(r)
            n_t = merge(t_all(t), t_own(t), targets_below)
            do e = starts(r), starts(r + 1) - 1
                s = entries(e)
                n_s = merge(s_all(s), s_own(s), sources_below)
                do k = s_start(s), s_start(s) + n_s - 1
                    do a = t_start(t), t_start(t) + n_t - 1
                        met(user_target(a), user(k)) = met(user_target(a), user(k)) + 1
                    end do
                end do
            end do
        end do
        call expect_ok(conn_release(list), 'release')
    end subroutine meet

    subroutine every_target_meets_every_source_once()
        integer, parameter :: n_s = 150, n_t = 90
        type(conn_context) :: context
        type(conn_tree) :: tree
        type(conn_lists) :: lists
        type(conn_tree_options) :: options
        type(conn_lists_options) :: choices
        type(conn_tree_view) :: boxes
        real(c_double), target :: sources(3, n_s), targets(n_t, 3), radii(n_t)
        integer :: met(0:n_t - 1, 0:n_s - 1), level
        sources = reshape(uniform(1, 3*n_s)**3, [3, n_s])
        targets = reshape(uniform(2, 3*n_t)**3, [n_t, 3])
        radii = 0.05_c_double*uniform(3, n_t)
        call expect_ok(conn_tree_options_init(options), 'defaults')
        call expect_ok(conn_lists_options_init(choices), 'defaults')
        options%max_particles_in_box = 5
        options%stick_out_factor = 0.25_c_double
        choices%from_sep_smaller_crit = CONN_CRIT_STATIC_L2
        call expect_ok(conn_context_create(context), 'context')
        call expect_ok(conn_tree_create(context, tree), 'tree')
        call expect_ok(conn_lists_create(context, lists), 'lists')
        call expect_ok(conn_tree_build(tree, 3, [conn_array_matrix(sources)], options, &
            [conn_array_vector(targets(:, 1)), conn_array_vector(targets(:, 2)), &
             conn_array_vector(targets(:, 3))], target_radii=conn_array_vector(radii)), 'build')
        call expect_ok(conn_lists_rebuild(lists, tree, choices), 'rebuild')
        call expect_ok(conn_acquire(tree, boxes), 'boxes')
        met = 0
        call meet(lists, boxes, CONN_LIST_NEIGHBOR_SOURCE_BOXES, 0, .false., .false., met)
        call meet(lists, boxes, CONN_LIST_FROM_SEP_CLOSE_SMALLER, 0, .false., .false., met)
        call meet(lists, boxes, CONN_LIST_FROM_SEP_CLOSE_BIGGER, 0, .false., .false., met)
        call expect(any(met == 0), 'not all interactions are direct')
        call meet(lists, boxes, CONN_LIST_FROM_SEP_SIBLINGS, 0, .true., .true., met)
        do level = 0, boxes%n_levels - 1
            call meet(lists, boxes, CONN_LIST_FROM_SEP_SMALLER, level, .false., .true., met)
        end do
        call meet(lists, boxes, CONN_LIST_FROM_SEP_BIGGER, 0, .true., .false., met)
        call expect(all(met == 1), 'each pair meets once')
        call expect_error(conn_tree_build(tree, 3, [conn_array_matrix(sources(:2, :))], options), &
                          CONN_E_ARGUMENT, 'sources', 'two axes')
        call expect_ok(conn_release(boxes), 'release')
        call expect_ok(conn_destroy(lists), 'destroy')
        call expect_ok(conn_destroy(tree), 'destroy')
        call expect_ok(conn_destroy(context), 'destroy')
    end subroutine every_target_meets_every_source_once

    subroutine lookups_find_leaves_balls_and_targets()
        type(conn_context) :: context
        type(conn_tree) :: tree, copy
        type(conn_tree_view) :: boxes
        type(conn_box_list_view) :: list
        type(conn_particles_view) :: kept
        integer(c_int64_t), pointer :: starts(:)
        integer(c_int32_t), pointer :: entries(:), ids(:), box_starts(:), counts(:)
        real(c_double), pointer :: places(:, :)
        real(c_double), target :: balls(2), radii(2), points(3)
        real(c_double) :: distances(15)
        integer(c_int64_t) :: n, bytes, scratch
        integer :: i
        character(:), allocatable :: text
        balls = [0.3_c_double, 2._c_double]
        radii = [0.1_c_double, 0.5_c_double]
        points = [0.1_c_double, 0.2_c_double, 0.3_c_double]
        call make_line(context, tree)
        call expect_ok(conn_tree_area_query(tree, [conn_array_vector(balls)], &
                                            conn_array_vector(radii), list), 'area')
        call conn_box_list_pointers(list, starts, entries)
        call expect(all(starts == [0, 3, 3]) .and. all(entries == [8, 9, 10]), 'leaves of balls')
        call expect_ok(conn_release(list), 'release')
        call expect_ok(conn_tree_leaves_to_balls(tree, [conn_array_vector(balls)], &
                                                 conn_array_vector(radii), list), 'balls')
        call conn_box_list_pointers(list, starts, entries)
        call expect(starts(8) == 0 .and. starts(11) == 3 .and. all(entries == 0), 'balls of leaves')
        call expect_ok(conn_release(list), 'release')
        call expect_ok(conn_tree_space_invader(tree, [conn_array_vector(balls)], &
                                               conn_array_vector(radii), n, distances), 'invader')
        call expect(n == 15 .and. abs(distances(9) - 0.1125_c_double) < 1e-15_c_double .and. &
                    distances(12) == 0, 'distances')
        call expect_ok(conn_tree_peers(tree, list), 'peers')
        call conn_box_list_pointers(list, starts, entries)
        call expect(all(entries(starts(9):starts(10) - 1) == [8, 9, 10]), 'peers of box 9')
        call expect_ok(conn_release(list), 'release')
        call expect_ok(conn_tree_filter_targets(tree, [(mod(i, 2) == 0, i=0, 7)], list), 'filter')
        call conn_box_list_pointers(list, starts, entries)
        call expect(all(entries == [0, 2, 4, 6]), 'kept targets')
        call expect_ok(conn_release(list), 'release')
        call expect_ok(conn_tree_filter_targets_in_tree_order(tree, [(i > 5, i=0, 7)], kept), 'kept')
        call conn_particles_pointers(kept, ids, box_starts, counts, positions=places)
        call expect(all(ids == [6, 7]) .and. box_starts(14) == 1 .and. counts(14) == 1 .and. &
                    size(places) == 0, 'in tree order')
        call expect_ok(conn_release(kept), 'release')
        call expect_error(conn_tree_link_point_sources(tree, [(0_c_int64_t, i=0, 8)], &
            [conn_array_vector(points)], kept), CONN_E_ARGUMENT, '', 'sources without radii or ends')
        call expect_ok(conn_tree_memory(tree, bytes, scratch), 'memory')
        call expect(bytes > 0, 'bytes')
        call expect_ok(conn_tree_release_scratch(tree), 'scratch')
        call expect_ok(conn_tree_report_text(tree, text), 'report')
        call expect(len(text) > 0, 'the report has a text')
        call expect_ok(conn_acquire(tree, boxes), 'boxes')
        call expect_ok(conn_tree_create(context, copy), 'copy')
        call expect_ok(conn_tree_set_boxes(copy, boxes), 'boxes of another tree')
        call expect_ok(conn_release(boxes), 'release')
        call expect_ok(conn_acquire(copy, boxes), 'boxes')
        call expect(boxes%n_boxes == 15, 'the same boxes')
        call expect_ok(conn_release(boxes), 'release')
        call expect_ok(conn_destroy(copy), 'destroy')
        call expect_ok(conn_destroy(tree), 'destroy')
        call expect_ok(conn_destroy(context), 'destroy')
    end subroutine lookups_find_leaves_balls_and_targets

end module trees_test
