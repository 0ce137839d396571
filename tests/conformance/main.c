/* SPDX-License-Identifier: BSD-3-Clause */
/*
 * conformance [-l library] [-s scene] [-t seconds] [-m]
 *   -l, -s  only names that begin so          -m  a table in Markdown instead of lines
 *   -t      what a library may take for a scene [60]
 * Ends with 1 if a library failed, 2 if nothing fits. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "judge.h"
#include "libraries.h"

static const char* const words[] = {"exact", "refused", "cannot",  "other points",
                                    "WRONG", "CRASHED", "TOO LONG"};

typedef struct settings {
    const char *library, *scene;
    int limit, table;
} settings;

static int begins_with(const char* text, const char* with) {
    return strncmp(text, with, strlen(with)) == 0;
}

/** One line. Returns 1 for a failure. */
static int report(const conf_library* library, const conf_scene* scene, int limit) {
    const conf_result r = conf_judge(library, scene, limit);
    printf("%-22s %-18s %-9s %8.3f s  %s\n", library->name, scene->name, words[r.verdict],
           r.seconds, r.text);
    fflush(stdout);
    return conf_failed(r.verdict);
}

static int report_lines(const settings* s) {
    int n_judged = 0, n_failed = 0;
    for (int l = 0; l < conf_n_libraries; ++l)
        for (int k = 0; k < conf_n_scenes; ++k) {
            const conf_library* const library = conf_libraries[l];
            if (!begins_with(library->name, s->library) ||
                !begins_with(conf_scenes[k].name, s->scene))
                continue;
            ++n_judged;
            n_failed += report(library, &conf_scenes[k], s->limit);
        }
    printf("%d of %d failed\n", n_failed, n_judged);
    return n_judged == 0 ? 2 : n_failed > 0;
}

static void print_cell(const conf_result* r) {
    if (conf_failed(r->verdict))
        printf(" **%s** %s |", r->verdict == CONF_WRONG ? "wrong:" : words[r->verdict], r->text);
    else
        printf(" %s |", words[r->verdict]);
}

/** Scenes down, libraries across. */
static int report_table(const settings* s) {
    int n_failed = 0, n_judged = 0;
    printf("| scene | pairs |");
    for (int l = 0; l < conf_n_libraries; ++l)
        if (begins_with(conf_libraries[l]->name, s->library))
            printf(" %s%s |", conf_libraries[l]->name,
                   (conf_libraries[l]->limits & CONF_SINGLE_PRECISION) != 0 ? " (float)" : "");
    printf("\n|---|---|");
    for (int l = 0; l < conf_n_libraries; ++l)
        if (begins_with(conf_libraries[l]->name, s->library)) printf("---|");
    for (int k = 0; k < conf_n_scenes; ++k) {
        const conf_scene* const scene = &conf_scenes[k];
        if (!begins_with(scene->name, s->scene)) continue;
        printf("\n| %s: %s | %lld |", scene->name, scene->about, (long long)scene->expected.count);
        for (int l = 0; l < conf_n_libraries; ++l) {
            if (!begins_with(conf_libraries[l]->name, s->library)) continue;
            fflush(stdout);
            const conf_result r = conf_judge(conf_libraries[l], scene, s->limit);
            print_cell(&r);
            ++n_judged;
            n_failed += conf_failed(r.verdict);
        }
    }
    printf("\n");
    return n_judged == 0 ? 2 : n_failed > 0;
}

int main(int argc, char** argv) {
    settings s = {"", "", 60, 0};
    for (int option; (option = getopt(argc, argv, "l:s:t:m")) != -1;) {
        switch (option) {
            case 'l': s.library = optarg; break;
            case 's': s.scene = optarg; break;
            case 't': s.limit = atoi(optarg); break;
            case 'm': s.table = 1; break;
            default: return 2;
        }
    }
    if (s.limit < 1 || optind < argc) {
        fprintf(stderr, "see the head of main.c\n");
        return 2;
    }
    return s.table ? report_table(&s) : report_lines(&s);
}
